// A drop that is wide enough to be looked into: an upside-down picture of what lies behind it, with the reflections of
// what lies before it. Narrower drops show their mean, which is the phase function of raindrop.h.
#pragma once

#include "shaders/drop_trace.h"

namespace pluvia {

/// The directions in which a camera's ray leaves a drop while the drop passes by, each blurred evenly within a cone so
/// that lamps can be sampled: a density over directions like a phase function. It integrates to 1 to a thousandth.
class DropLens {
public:
    /// width: of the drop in pixels. The cone is what a pixel blurs anyway: 166 degrees of the world behind the drop
    /// lie on its width. Half angle at most 8 degrees, where it does not differ from the phase function by more than a
    /// few per cent in any direction; at least 2, so that small lamps are found.
    explicit DropLens(float width);

    /// One moment of `moments` in which the ray is covered. direction: of the ray, scene (y up), unit. across: from the
    /// drop's centre to the ray, in radii, perpendicular to the direction. On a drop that is not round it is stretched
    /// to its silhouette at rest; a ray that misses it as it oscillates goes straight on.
    void add(const DropShape& shape, Vec3 direction, Vec3 across, int moments);

    /// 1/sr; also the pdf of sample().
    float evaluate(Vec3 wi) const;
    Vec3 sample(Vec2 u) const;

    static constexpr int max_moments = 4;

private:
    std::array<DropExit, 12 * max_moments> cones_;
    int count_ = 0;
    float one_minus_cos_, density_;
};

}  // namespace pluvia
