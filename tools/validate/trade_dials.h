// The dials of the renderer and where `pluvia validate trade` sets them.
#pragma once

#include "tools/render_options.h"

#include <functional>
#include <string>
#include <vector>

namespace pluvia {

/// One dial at one place, all others as the options have them.
struct TradeSetting {
    std::string dial, value;
    bool biased = false;                               // more samples do not lead to the reference
    std::function<void(RenderOptions&)> options = {};  // what it changes of them
    std::function<void(RenderSettings&)> code = {};    // of what has no option
    bool reloads = false;                              // the scene or its light is another, not just its samples
};

/// What a dial is, for help and reports.
struct TradeDial {
    const char* name;
    const char* meaning;
};

/// All of them, in the order in which they are measured.
const std::vector<TradeDial>& trade_dials();
/// Throws Error (usage) for a name that is none of a dial.
void check_dials(const std::vector<std::string>& names);
/// rains: whether there is rain, without which some dials say nothing. physical: its composition.
std::vector<TradeSetting> trade_settings(bool rains, bool physical);

}  // namespace pluvia
