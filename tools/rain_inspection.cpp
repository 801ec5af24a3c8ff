#include "tools/rain_inspection.h"

#include "renderer/core/error.h"
#include "renderer/core/units.h"
#include "renderer/rain/rain_statistics.h"
#include "renderer/scene/camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace pluvia {
namespace {

/// A level camera in the middle of the rain, where neither ground nor the top of the rain is in sight.
View inspecting_view(const RainInspectionOptions& o) {
    CameraSettings camera;
    int read = 0;
    if (std::sscanf(o.size.c_str(), "%dx%d%n", &camera.width, &camera.height, &read) != 2 ||
        size_t(read) != o.size.size() || camera.width < 1 || camera.height < 1 || camera.width > 32768 ||
        camera.height > 32768)
        throw usage_error("--size",
                          fmt::format("is not valid (got \"{}\", expected WIDTHxHEIGHT, each 1 to 32768)", o.size));
    if (!(o.focal_length >= 1 && o.focal_length <= 10000))
        throw usage_error("--focal-length",
                          fmt::format("is not valid (got {}, expected 1 to 10000 mm)", o.focal_length));
    camera.focal_length = metres_from_mm(o.focal_length);
    return make_view(Camera(), camera);
}

/// Streaks whose drop is in the picture at mid-exposure.
int64_t count_in_picture(const std::vector<Streak>& streaks, const View& view) {
    return std::count_if(streaks.begin(), streaks.end(), [&](const Streak& s) {
        const Vec3 middle = s.start + s.velocity * float(view.exposure_time / 2);
        const Vec2 p = view.pixel_from_view(middle);
        return p.x >= 0 && p.y >= 0 && p.x < float(view.width) && p.y < float(view.height);
    });
}

/// Enough digits to compare, few enough to read.
double rounded(double value) {
    return std::isfinite(value) ? std::stod(fmt::format("{:.4e}", value)) : value;
}

}  // namespace

void add_rain_inspection_options(CLI::App& command, RainInspectionOptions& o) {
    command.add_option("--rain", o.intensities, "print the drop statistics of these intensities, mm/h")->delimiter(',');
    command.add_option("--size", o.size, "with --rain: of the picture, WIDTHxHEIGHT in pixels")->capture_default_str();
    command.add_option("--focal-length", o.focal_length, "with --rain: mm on a sensor 36 mm wide")
        ->capture_default_str();
    command.add_option("--streak-width", o.streak_width, "with --rain: pixels from which on a drop is resolved")
        ->capture_default_str();
    command.add_option("--seed", o.seed, "with --rain: of the drops that are counted")->capture_default_str();
}

nlohmann::ordered_json inspect_rain(const RainInspectionOptions& o) {
    nlohmann::ordered_json all;
    const View view = inspecting_view(o);
    for (const double intensity : o.intensities) {
        RainSettings settings;
        settings.intensities_mm_per_h = {intensity};
        settings.min_width_pixels = o.streak_width;
        settings.seed = o.seed;
        settings.lowest_ground = view.position.y - 500;
        const std::vector<Streak> streaks = find_streaks(view, settings);
        const RainStatistics s = rain_statistics(intensity);
        nlohmann::ordered_json& j = all[fmt::format("{:g}", intensity)];
        j["intensity_mm_per_h"] = intensity;
        j["drops_per_m3"] = rounded(s.drops_per_m3);
        j["median_volume_diameter_mm"] = rounded(s.median_volume_diameter * 1e3);
        j["liquid_water_g_per_m3"] = rounded(s.liquid_water * 1e3);
        j["volume_flux_mm_per_h"] = rounded(s.volume_flux * 3.6e6);
        j["extinction_per_m"] = rounded(s.extinction);
        if (s.extinction > 0) j["visibility_m"] = rounded(s.visibility);
        j["resolved_drops_expected"] = rounded(expected_streaks(view, settings, intensity));
        j["resolved_drops_drawn"] = count_in_picture(streaks, view);
        j["resolved_share_of_30_m"] = rounded(resolved_share(view, settings, intensity, 30));
        j["resolved_share_of_100_m"] = rounded(resolved_share(view, settings, intensity, 100));
    }
    return all;
}

}  // namespace pluvia
