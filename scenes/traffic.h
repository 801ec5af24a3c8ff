// Traffic: cars that drive and people who walk through a street that was built, and a camera that drives with them.
#pragma once

#include "renderer/scene/gltf.h"

#include <vector>

namespace pluvia {

constexpr float traffic_seconds = 12;  // as long as cameras walk

/// Adds to a street of builders.h what moves in it: people, cars where there is a carriageway, and there a camera
/// "drive". Returns how they move; the scene holds them where they are at the start. The same every time.
std::vector<NodeMotion> add_traffic(Scene& scene);

}  // namespace pluvia
