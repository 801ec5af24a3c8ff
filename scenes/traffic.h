// Traffic: cars that drive and people who walk through a street that was built, and a camera that drives with them.
#pragma once

#include "renderer/scene/gltf.h"

#include <vector>

namespace pluvia {

constexpr float traffic_seconds = 100;  // a thousand frames, 10 a second

/// Adds to a street of builders.h what moves in it for traffic_seconds: people, cars where there is a carriageway, and
/// a camera "drive" among them. Returns how they move; the scene holds them where they are at the start. The same every
/// time.
std::vector<NodeMotion> add_traffic(Scene& scene);

}  // namespace pluvia
