// Named settings of accuracy. Their errors and costs are measured by `pluvia validate trade`.
#pragma once

#include "tools/render_options.h"

#include <string>
#include <vector>

namespace pluvia {

/// Samples alone: dials that bias save less time than they add error (README, "What accuracy costs").
struct Quality {
    const char* name;
    int samples;  // per pixel
};

/// From the quickest to the most accurate.
const std::vector<Quality>& qualities();

/// Throws Error (usage) for a name that is not in the list.
void set_quality(RenderOptions& options, const std::string& name);

}  // namespace pluvia
