// The street scenes by name. Each is built from nothing but numbers, the same bytes every time.
#pragma once

#include "renderer/scene/scene.h"

#include <functional>
#include <string>
#include <vector>

namespace pluvia {

struct Builder {
    std::string name;         // of the scene and its file
    std::string description;  // one line
    std::function<Scene()> build;
};

/// All scenes in the order in which they are listed to users.
const std::vector<Builder>& builders();

/// A narrow Japanese alley of timber houses, 3 m wide and 25 m long. Cameras: front, mid, side, low.
Scene build_lane();

}  // namespace pluvia
