#include "tools/quality.h"

#include "tools/option_check.h"

namespace pluvia {

const std::vector<Quality>& qualities() {
    static const std::vector<Quality> list = {{"draft", 16}, {"standard", 64}, {"high", 256}, {"reference", 1024}};
    return list;
}

void set_quality(RenderOptions& options, const std::string& name) {
    std::string names;
    for (const Quality& quality : qualities()) {
        if (name == quality.name) {
            options.spp = quality.samples;
            return;
        }
        names += (names.empty() ? "" : ", ") + std::string(quality.name);
    }
    fail_option("quality", '"' + name + '"', names);
}

}  // namespace pluvia
