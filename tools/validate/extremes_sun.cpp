// The sun in the zenith, on the horizon, just below it, at the end of twilight and under one's feet.
#include "renderer/core/units.h"
#include "shaders/sky.h"
#include "tools/sky_cache.h"
#include "tools/validate/extremes.h"
#include "tools/validate/known_scenes.h"
#include "tools/validate/running_mean.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace pluvia {
namespace {

RunningMean ground_luminance(const Scene& ground, const Environment& sky, const View& view, int seeds) {
    RunningMean result;
    for (int k = 0; k < seeds; ++k) {
        const Picture p = render_picture(ground, sky, view, {.samples = 1024, .seed = uint64_t(k)});
        result.add(luminance({float(sound_mean(p, "background.R")), float(sound_mean(p, "background.G")),
                              float(sound_mean(p, "background.B"))}));
    }
    return result;
}

}  // namespace

std::vector<ExtremeResult> measure_sun_extremes(bool full) {
    std::vector<ExtremeResult> results;
    const SkyTables tables = cached_sky_tables({});
    const Scene ground = make_plane(lambert(Rgb(0.5f)));
    const View view = look_at({4, 1.5, 3}, {0, 0, 0}, 4, 4, 1e5);
    double before = 0;
    for (const double degrees : {-90.0, -18.0, -0.27, 0.0, 90.0}) {
        SkySettings settings;
        settings.sun_elevation = radians_from_degrees(degrees);
        const Environment sky = make_sky(tables, settings);
        const double lux = sky.horizontal_illuminance();
        // 2e-3: the illuminance takes the sky as constant within a texel, and the disc as a point at its centre; on the
        // horizon, where half of the disc stands above it, that is one part in a hundred.
        results.push_back(mean_result(fmt::format("ground under the sky, sun at {} degrees: albedo E / pi", degrees),
                                      0.5 / std::numbers::pi * lux, ground_luminance(ground, sky, view, full ? 32 : 4),
                                      (degrees == 0 ? 1e-2 : 2e-3) * 0.5 / std::numbers::pi * lux));
        if (degrees < -0.2666)
            results.push_back({fmt::format("sunlight, sun at {} degrees: its upper limb is below", degrees), 0,
                               sky.disc_illuminance(), 0});
        results.push_back({fmt::format("lux that {} degrees lack to the next lower sun", degrees), 0,
                           std::max(0.0, before - lux), 0});
        before = lux;
    }
    return results;
}

}  // namespace pluvia
