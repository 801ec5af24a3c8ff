// Rings on standing water: one around each place where a drop has fallen, as many as it rains, running and fading in
// time. A pure function of place, time and seed.
#pragma once

#include "renderer/core/vec.h"
#include "renderer/rain/poisson.h"

#include <array>
#include <cstdint>

namespace pluvia {

class Ripples {
public:
    /// intensity: 0 to 1000 mm/h; 0: no rings.
    Ripples(double intensity_mm_per_h, uint64_t seed);

    /// Slope dh/dx, dh/dz of the water's surface. world: only x and z matter. time: seconds of the sequence.
    Vec2 slope(Vec3d world, double time) const;

    /// Rings that are started per square metre and second, by drops of 0.5 mm and more: smaller ones leave no mark.
    double rate() const;

private:
    /// Rings by drops of similar size: all of the mean size of those that arrive.
    struct Kind {
        double rate = 0;                                // per m2 and s
        double life = 0;                                // seconds until a ring is left out
        float drop = 0;                                 // diameter, metres
        float wave_number = 0, speed = 0, damping = 0;  // 1/m, m/s, 1/s
        float reach = 0;                                // metres
        PoissonCounts counts;                           // in a cell of place and time
    };
    static Kind make_kind(double intensity, double d1, double d2, double life);
    Vec2 slope(const Kind& kind, uint64_t key, Vec3d world, double time) const;

    std::array<Kind, 3> kinds_;
    uint64_t seed_;
};

}  // namespace pluvia
