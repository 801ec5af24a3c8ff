// The parts of camera rays where no rain falls, for the medium of fine rain. Pixels of a block share those of the ray
// through its middle, but where they see past what stops that ray: at 2048 pixels and 35 mm a block is 2 cm wide at
// 10 m, less than a cell of the rain shadow.
#pragma once

#include "renderer/core/view.h"
#include "renderer/rain/rain_medium.h"
#include "renderer/transport/rain_shadow.h"

#include <vector>

namespace pluvia {

/// Of one ray, in rising order, found as far as somebody has asked.
class DryParts {
public:
    /// The ray ends at the first surface. What lies just before that goes on beyond, for rays that pass beside.
    DryParts(const RainShadow& shadow, const Ray& ray);

    /// Whether a ray beside that ends at this distance may have met the same surface, seen at a glancing angle perhaps.
    bool serves(float distance) const { return distance <= 1.25f * ray_.t_max + 1; }

    /// All parts that begin before `distance`; the last one may go on beyond it.
    std::span<const DryPart> up_to(float distance, Counters& counters);

private:
    const RainShadow* shadow_;
    Ray ray_;
    float end_, reached_ = 0;  // metres: beyond the first nothing is sheltered; what lies before the second is known
    std::vector<DryPart> parts_;
};

/// Those of the blocks that a tile works on: a tile's rows are finished from left to right, one after the other.
class DryPartsOfTile {
public:
    static constexpr int block = 4;  // pixels

    /// distance: to the first surface of a ray through pixel x, y.
    std::span<const DryPart> up_to(const RainShadow& shadow, const RayScene& ray_scene, const View& view, int x, int y,
                                   float distance, Counters& counters);

private:
    /// Of the block or, with size 1, of the pixel.
    struct Square {
        int x, y, size;
        DryParts parts;
    };
    DryParts& parts_of(int size, const RainShadow& shadow, const RayScene& ray_scene, const View& view, int x, int y,
                       Counters& counters);

    int row_ = -1;  // of blocks
    std::vector<Square> squares_;
};

}  // namespace pluvia
