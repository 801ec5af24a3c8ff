// Laws that rain obeys as a whole: with distance, with what it hides, with where light comes from, and with intensity.
#include "renderer/rain/coverage.h"
#include "tests/statistics.h"
#include "tests/test_scenes.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

namespace pluvia {
namespace {

constexpr double pi_d = std::numbers::pi;

/// Looks north (-z) through the air of an empty scene; 0.9 x 0.5 degrees at 4000 pixels.
View air_view(double focal_pixels) {
    View view;
    view.width = 64, view.height = 32;
    view.focal_pixels = focal_pixels;
    view.position = Vec3d(0, 2, 0);
    return view;
}

/// One radiance from within an angle of straight ahead (-z), another from everywhere else.
Environment ahead_and_beside(double degrees, Rgb ahead, Rgb beside) {
    Image<Rgb> picture(1024, 512);
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            const Vec3 d = direction_from_equirectangular((x + 0.5) / picture.width, (y + 0.5) / picture.height);
            picture.at(x, y) = -d.z > std::cos(degrees * pi_d / 180) ? ahead : beside;
        }
    return Environment(std::move(picture));
}

RenderSettings heavy_rain(double streak_width) {
    RenderSettings settings;
    settings.samples = 8;
    settings.rain.intensities_mm_per_h = {100};
    settings.rain.min_width_pixels = streak_width;
    return settings;
}

/// Light of all rain over the part of the background that it takes away, from independent seeds.
struct RainLight {
    RunningMean r, g, b;
};
RainLight light_of_rain(const Environment& world, const View& view, RenderSettings settings, int seeds) {
    RainLight light;
    for (int seed = 0; seed < seeds; ++seed) {
        settings.seed = settings.rain.seed = uint64_t(seed);
        const Picture picture = render_picture(Scene(), world, view, settings);
        const double taken = 1 - picture.mean("transmittance_100.G");
        const auto of = [&](const std::string& c) {
            return (picture.mean("rain_100." + c) + picture.mean("inscatter_100." + c)) / taken;
        };
        light.r.add(of("R")), light.g.add(of("G")), light.b.add(of("B"));
    }
    return light;
}

}  // namespace

TEST_CASE("with its distance a drop's coverage stays, its width falls as 1 / z, and with it the mean over a pixel") {
    const float exposure = 1.0f / 60, radius = 1e-3f, speed = 5.8f;
    const double focal = 1000, whole = 2 * radius / (speed * exposure);
    for (const float z : {0.5f, 1.0f, 2.0f, 4.0f, 8.0f, 16.0f}) {
        CAPTURE(z);
        const Streak streak{{0, speed * exposure / 2, z}, {0, -speed, 0}, radius, 1, 1};
        // A row across the middle of the streak in steps of a two hundredth of its width; the pixel in its middle.
        const double width = 2 * radius * focal / z, step = width / 200;
        double widest = 0, covered_pixels = 0, sum = 0;
        const int half = int(std::ceil(std::max(width, 1.0) / step));
        for (int i = -half; i <= half; ++i) {
            const double x = (i + 0.5) * step;
            const auto covered = covered_interval(streak, {Vec3(), normalize(Vec3(float(x / focal), 0, 1))}, exposure);
            if (!covered) continue;
            widest = std::max(widest, double(covered->fraction()));
            covered_pixels += step;
            if (std::abs(x) < 0.5) sum += covered->fraction() * step;
        }
        CHECK(widest == doctest::Approx(whole).scale(0).epsilon(1e-3));
        CHECK(covered_pixels == doctest::Approx(width).scale(0).epsilon(0.02));
        if (width <= 1) CHECK(sum == doctest::Approx(pi_d / 4 * whole * width).scale(0).epsilon(0.01));
        if (width >= 4) CHECK(sum == doctest::Approx(whole).scale(0).epsilon(0.02));
    }
}

TEST_CASE("rain takes away in proportion to what it hides and adds the same light whatever that is") {
    // Only the view itself, 2 degrees around its centre, changes; of the light in a drop it is half a per cent.
    constexpr double share = 0.005;
    for (const float hidden : {0.0f, 1.0f, 4.0f}) {
        CAPTURE(hidden);
        const Environment world = ahead_and_beside(2, Rgb(hidden), Rgb(1));
        const RainLight light = light_of_rain(world, air_view(4000), heavy_rain(0.25), 24);
        CAPTURE(light.g.mean());
        CHECK(light.g.agrees_with(1 - share + share * hidden, 0.003));
        CHECK(light.g.standard_error() < 0.01);
    }
}

TEST_CASE("rain has the colour of the light that comes through it: 59 % from within 30 degrees, 91 % from within 60") {
    // Shares of a sphere of water, all orders; wide drops, seen as lenses, are flat and send one to two per cent more
    // straight on.
    for (const auto& [degrees, expected] : {std::pair(30.0, 0.588), std::pair(60.0, 0.913)}) {
        CAPTURE(degrees);
        const Environment world = ahead_and_beside(degrees, Rgb(1, 0.5f, 0), Rgb(0, 0.5f, 1));
        for (const double streak_width : {0.25, 1.0}) {
            CAPTURE(streak_width);
            RenderSettings settings = heavy_rain(streak_width);
            const RainLight light = light_of_rain(world, air_view(streak_width < 1 ? 500 : 4000), settings, 24);
            CHECK(light.r.agrees_with(expected, 0.02));
            CHECK(light.g.agrees_with(0.5, 0.002));
            CHECK(light.b.agrees_with(1 - expected, 0.02));
            CHECK(light.r.standard_error() < 0.02);
        }
    }
}

TEST_CASE("with intensity coverage, veil and number of streaks grow in every pixel") {
    RenderSettings settings = heavy_rain(0.25);
    settings.rain.intensities_mm_per_h = {10, 25, 50, 100};
    View view = air_view(400);
    const Picture picture = render_picture(Scene(), Environment::uniform(Rgb(1)), view, settings);
    const char* const labels[] = {"010", "025", "050", "100"};
    double before = 0;
    for (int i = 0; i < 4; ++i) {
        const std::string label = labels[i];
        const auto &a = picture.plane("rain_" + label + ".A"), &t = picture.plane("transmittance_" + label + ".G");
        for (size_t k = 0; i > 0 && k < a.size(); ++k) {
            CHECK(a[k] >= picture.plane(std::string("rain_") + labels[i - 1] + ".A")[k]);
            CHECK(t[k] <= picture.plane(std::string("transmittance_") + labels[i - 1] + ".G")[k] + 1e-6f);
        }
        const double covered = picture.mean("rain_" + label + ".A");
        CHECK(covered > 1.3 * before);
        before = covered;
        RainSettings rain = settings.rain;
        rain.intensities_mm_per_h = {settings.rain.intensities_mm_per_h[size_t(i)]};
        rain.lowest_ground = -100;
        const size_t streaks = find_streaks(view, rain).size();
        rain.intensities_mm_per_h = {rain.intensities_mm_per_h[0] / 2};
        CHECK(find_streaks(view, rain).size() < streaks);
    }
}

}  // namespace pluvia
