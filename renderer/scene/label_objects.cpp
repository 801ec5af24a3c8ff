#include "renderer/scene/label_objects.h"

#include "renderer/core/random.h"
#include "renderer/scene/taxonomy.h"

#include <map>
#include <set>

namespace pluvia {
namespace {

struct Found {
    std::string name;
    int class_id = unlabeled_id;
    std::string unknown_class = {};
};

/// The rule of the node itself comes before those of the nodes above it, and the first of several before the others.
bool find_by_rule(const std::string& path, const std::vector<LabelRule>& rules, Found& found) {
    for (size_t end = path.size(); end != std::string::npos && end > 0; end = path.rfind('/', end - 1)) {
        const std::string node = path.substr(0, end);
        for (const LabelRule& rule : rules) {
            std::smatch match;
            if (!std::regex_match(node, match, rule.path)) continue;
            found = {rule.object.empty() ? node : match.format(rule.object), rule.class_id};
            return true;
        }
    }
    return false;
}

}  // namespace

SceneObjects label_objects(const Scene& scene, const std::vector<std::string>& labelled_paths,
                           const std::vector<LabelRule>& rules) {
    SceneObjects result;
    std::map<std::string, int> index_of_name;
    std::map<std::string, Found> found_of_path;  // instances share paths
    std::map<int, int> count_of_class;
    std::set<uint32_t> ids;
    for (size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const auto [entry, is_new_path] = found_of_path.try_emplace(instance.name);
        Found& found = entry->second;
        if (is_new_path && !find_by_rule(instance.name, rules, found)) {
            found.name = labelled_paths.empty() ? instance.name : labelled_paths[i];
            const int known = instance.semantic.empty() ? unlabeled_id : class_id(instance.semantic);
            if (known < 0)
                found.unknown_class = instance.semantic;
            else
                found.class_id = known;
        }
        const auto [place, is_new] = index_of_name.try_emplace(found.name, int(result.objects.size()));
        if (is_new) {
            LabelObject object{found.name, instance_id(found.name), found.class_id, count_of_class[found.class_id]++,
                               found.unknown_class};
            // Two names in a million pairs of a large scene share a hash: the later one takes the next that is free.
            while (object.id == 0 || !ids.insert(object.id).second) object.id = uint32_t(mix_bits(object.id + 1));
            result.objects.push_back(std::move(object));
        }
        result.object_of_instance.push_back(place->second);
    }
    return result;
}

}  // namespace pluvia
