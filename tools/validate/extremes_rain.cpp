// Rain at its ends: none, a drop an hour, a wall of water; shutters, lenses and winds that must not matter to how much
// of a ray the drops cover, since that is Beer-Lambert's law whatever moves.
#include "renderer/rain/drop_size.h"
#include "tools/validate/extremes.h"
#include "tools/validate/known_scenes.h"
#include "tools/validate/running_mean.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace pluvia {
namespace {

constexpr double height = 500;  // of the camera: far from the ground and from where the rain begins

Scene card(double distance) {
    Scene scene;
    const float size = float(std::min(10 * distance, 400.0));  // within the rain's height
    add_quad(scene, {-size, float(height) - size, float(-distance)}, {2 * size, 0, 0}, {0, 2 * size, 0},
             emitter(Rgb(1)));
    return scene;
}

View straight_ahead(int width, int height_pixels, double focal_pixels) {
    return look_at({0, height, 0}, {0, height, -1}, width, height_pixels, focal_pixels);
}

RenderSettings rain_of(double intensity, double min_width) {
    RenderSettings settings{.samples = 4};
    settings.rain.intensities_mm_per_h = {intensity};
    settings.rain.min_width_pixels = min_width;
    return settings;
}

/// 1 - exp(-optical depth), mean over pixels and lens, of the drops at least or at most so wide before a card.
double covered_share(const View& view, const RainSettings& rain, double distance, bool wide) {
    constexpr int steps = 20000;
    const double step = (distance - rain.near) / steps;
    double depth = 0;  // along the view axis
    for (int i = 0; i < steps; ++i) {
        const double z = rain.near + (i + 0.5) * step;
        const double limit = std::clamp(rain.min_width_pixels * z / view.focal_pixels, smallest_drop, largest_drop);
        depth +=
            step * extinction(rain.intensities_mm_per_h[0], wide ? limit : smallest_drop, wide ? largest_drop : limit);
    }
    // Slanting rays are longer; those from the rim of a lens that focuses close by, much.
    RunningMean covered;
    const int rings = view.lens_radius > 0 ? 16 : 1, directions = view.lens_radius > 0 ? 16 : 1;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x)
            for (int ring = 0; ring < rings; ++ring)
                for (int k = 0; k < directions; ++k) {
                    const double r = view.lens_radius / view.focus_distance * std::sqrt((ring + 0.5) / rings),
                                 angle = 2 * std::numbers::pi * (k + 0.5) / directions;
                    const Vec3d d = Vec3d(view.view_direction({float(x) + 0.5f, float(y) + 0.5f})) -
                                    Vec3d(r * std::cos(angle), r * std::sin(angle), 0);
                    covered.add(-std::expm1(-depth * length(d)));
                }
    return covered.mean();
}

std::string layer(const char* name, double intensity, const char* channel) {
    return fmt::format("{}_{}.{}", name, intensity_label(intensity), channel);
}

}  // namespace

std::vector<ExtremeResult> measure_rain_extremes(bool full) {
    std::vector<ExtremeResult> results;

    const Scene near_card = card(6);
    const Picture dry = render_picture(near_card, Environment(), straight_ahead(8, 4, 16), rain_of(0, 0.25));
    results.push_back(
        {"0 mm/h: rainy over clean picture", 1, sound_mean(dry, "rainy_000.G") / sound_mean(dry, "background.G"), 0});
    results.push_back({"0 mm/h: coverage", 0, sound_mean(dry, "rain_000.A"), 0});

    // All rain as a medium, so that there is no chance in it. 2e-3: its profile is linear between steps of depth.
    for (const auto& [intensity, distance] : {std::pair{1e-3, 1500.0}, {1000.0, 60.0}}) {
        const View view = straight_ahead(4, 2, 16);
        const RenderSettings settings = rain_of(intensity, 1000);
        const Picture picture = render_picture(card(distance), Environment(), view, settings);
        results.push_back(relative_result(
            fmt::format("{} mm/h: light that a medium takes on {} m, Beer-Lambert", intensity, distance),
            covered_share(view, settings.rain, distance, false),
            1 - sound_mean(picture, layer("transmittance", intensity, "G")), 2e-3));
    }

    struct Case {
        std::string name;
        double intensity = 100, shutter = 1.0 / 60, focal_pixels = 64, width = 0.04, f_number = 0, focus = 10;
        Vec3d wind = {}, velocity = {};
    };
    const double fall = fall_speed(2e-3);
    std::vector<Case> cases = {{.name = "1e-3 mm/h", .intensity = 1e-3, .shutter = 1, .width = 0.002},
                               {.name = "1000 mm/h", .intensity = 1000},
                               {.name = "shutter 1/8000 s", .shutter = 1.0 / 8000},
                               {.name = "shutter 1 s", .shutter = 1},
                               {.name = "focal length 4 mm", .focal_pixels = 64 * 4 / 36.0},
                               {.name = "focal length 800 mm", .focal_pixels = 64 * 800 / 36.0},
                               {.name = "wind 0", .wind = {0, 0, 0}},
                               {.name = "wind 60 m/s across", .wind = {60, 0, 0}},
                               {.name = "camera falls with drops of 2 mm, which hang still", .velocity = {0, -fall, 0}},
                               {.name = "f/64", .f_number = 64},
                               {.name = "f/0.7 of 36 mm, focus at 5 cm", .f_number = 0.7, .focus = 0.05}};
    for (const Case& c : cases) {
        View view = straight_ahead(64, 32, c.focal_pixels);
        view.exposure_time = c.shutter, view.velocity = c.velocity;
        if (c.f_number > 0) view.lens_radius = 0.036 / (2 * c.f_number), view.focus_distance = c.focus;
        const RenderSettings settings = rain_of(c.intensity, c.width);
        // 1e-3: rays cross a pixel at places other than its centre.
        const double expected = covered_share(view, settings.rain, 6, true);
        results.push_back(mean_result(
            "coverage by streaks before 6 m, " + c.name, expected,
            sound_means(near_card, Environment(), view, settings, layer("rain", c.intensity, "A"), full ? 96 : 8),
            1e-3 * expected));
    }

    // In an even world rain is not seen, whatever it does.
    const Environment world = Environment::uniform(Rgb(1));
    for (Case c : {Case{.name = "1e-3 mm/h", .intensity = 1e-3},
                   {.name = "1000 mm/h, shutter 1 s, wind 60 m/s towards the camera",
                   .intensity = 1000,
                   .shutter = 1,
                   .wind = {0, 0, 60}},
                   {.name = "1000 mm/h, f/0.7, focus at 5 cm, shutter 1/8000 s",
                   .intensity = 1000,
                   .shutter = 1.0 / 8000,
                   .f_number = 0.7,
                   .focus = 0.05}}) {
        View view = court_view(16, 8);
        view.exposure_time = c.shutter;
        if (c.f_number > 0) view.lens_radius = 0.036 / (2 * c.f_number), view.focus_distance = c.focus;
        RenderSettings settings = rain_of(c.intensity, 0.25);
        settings.rain.wind = c.wind, settings.samples = 32;
        results.push_back(mean_result("white furnace behind rain, " + c.name, 1,
                                      sound_means(make_court(lambert(Rgb(1))), world, view, settings,
                                                  layer("rainy", c.intensity, "G"), full ? 32 : 4),
                                      1e-5));
    }
    return results;
}

}  // namespace pluvia
