// How far a lamp's halo in rain is from the truth when light is scattered once, between lamp and camera, and is not
// weakened on its way from the lamp to the drop, as the rain stage has it: against light scattered up to ten times and
// weakened everywhere, in rain that fills all space. Prints a table; no options.
//   cmake --build build --target halo
#include "renderer/core/random.h"
#include "renderer/rain/drop_size.h"
#include "renderer/transport/equiangular.h"
#include "renderer/transport/scatter_function.h"

#include <cmath>
#include <cstdio>
#include <numbers>

using namespace pluvia;

namespace {

constexpr int orders = 10, batches = 64, paths = 40000;  // paths of a batch

struct Halo {
    double once = 0, full = 0;  // radiance for a lamp of 1 cd
};

/// Of one path that leaves the camera in a direction; extinction: 1/m.
Halo follow(Vec3 direction, Vec3 lamp, float extinction, uint64_t seed) {
    Halo halo;
    Ray ray{Vec3(), direction};
    for (int order = 0; order < orders; ++order) {
        const auto u = [&](uint64_t n) { return unit_float(hash_key(seed, uint64_t(order), n)); };
        const EquiangularDistance near_lamp(ray, lamp, 0, 2000);
        const float distance = near_lamp.sample(u(0));
        const Vec3 to_lamp = lamp - ray.at(distance);
        const DropScatter drop{ray.direction};
        const float scattered = extinction * std::exp(-extinction * distance) / near_lamp.pdf(distance);
        const double light = scattered * drop.evaluate(normalize(to_lamp)).value / length_squared(to_lamp);
        if (order == 0) halo.once = light;
        halo.full += light * std::exp(-extinction * length(to_lamp));
        ray = {ray.at(-std::log(1 - u(1)) / extinction), drop.sample({u(2), u(3)})};
    }
    return halo;
}

}  // namespace

int main() {
    std::printf("%8s %8s %8s %28s\n", "mm/h", "lamp, m", "degrees", "scattered once over truth, %");
    for (const double intensity : {10.0, 100.0})
        for (const float away : {10.0f, 30.0f, 100.0f})
            for (const double degrees : {2.0, 10.0, 20.0, 40.0, 60.0}) {
                const double angle = degrees * std::numbers::pi / 180;
                const Vec3 direction(float(std::sin(angle)), 0, float(std::cos(angle)));
                double sum = 0, squares = 0;
                for (int batch = 0; batch < batches; ++batch) {
                    Halo mean;
                    for (int i = 0; i < paths; ++i) {
                        const uint64_t seed = hash_key(1, uint64_t(batch), uint64_t(i));
                        const Halo one = follow(direction, {0, 0, away}, float(extinction(intensity)), seed);
                        mean.once += one.once, mean.full += one.full;
                    }
                    const double off = 100 * (mean.once / mean.full - 1);
                    sum += off, squares += off * off;
                }
                const double mean = sum / batches, variance = squares / batches - mean * mean;
                std::printf("%8g %8g %8g %18.2f +- %.2f\n", intensity, away, degrees, mean,
                            std::sqrt(variance / (batches - 1)));
            }
}
