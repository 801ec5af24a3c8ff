#include "tools/label_rules.h"

#include "renderer/core/error.h"
#include "renderer/scene/taxonomy.h"
#include "tools/dataset/config_tree.h"
#include "tools/dataset/suggestion.h"
#include "tools/label_pattern.h"

#include <fmt/format.h>

namespace pluvia {
namespace {

using Kind = ConfigNode::Kind;

LabelRule read_rule(const std::string& path, const ConfigNode& node) {
    const auto fail = [&](int line, const std::string& what) -> Error {
        return usage_error(fmt::format("{}:{}", path, line), what);
    };
    if (node.kind != Kind::map) throw fail(node.line, "is no rule (expected the keys nodes and class)");
    LabelRule rule;
    bool has_class = false;
    for (const ConfigEntry& entry : node.entries) {
        const std::string& text = entry.value.text;
        if (entry.value.kind != Kind::scalar) throw fail(entry.line, entry.key + " is not a single value");
        if (entry.key == "nodes") {
            rule.pattern = text;
            rule.path = compile_label_pattern(text, fmt::format("{}:{}", path, entry.line));
        } else if (entry.key == "class") {
            rule.class_id = class_id(text);
            has_class = true;
            if (rule.class_id >= 0) continue;
            std::vector<std::string> names;
            for (const LabelClass& c : taxonomy()) names.emplace_back(c.name);
            const std::string near = nearest_word(text, names);
            throw fail(entry.line,
                       fmt::format("there is no class \"{}\" (expected one of {}){}", text, fmt::join(names, ", "),
                                   near.empty() ? "" : "; did you mean " + near + "?"));
        } else if (entry.key == "object") {
            rule.object = text;
        } else {
            throw fail(entry.line, fmt::format("there is no key \"{}\" (expected nodes, class or object)", entry.key));
        }
    }
    if (rule.pattern.empty()) throw fail(node.line, "a rule has no key \"nodes\"");
    if (!has_class) throw fail(node.line, "a rule has no key \"class\"");
    return rule;
}

}  // namespace

std::vector<LabelRule> read_label_rules(const std::string& path) {
    const ConfigNode root = read_config_tree(path);
    if (root.kind != Kind::list)
        throw usage_error(path, "holds no rules (expected a list of entries with the keys nodes and class)");
    std::vector<LabelRule> rules;
    for (const ConfigNode& node : root.items) rules.push_back(read_rule(path, node));
    return rules;
}

}  // namespace pluvia
