// The medium of fine rain: with the streaks it is all of the rain, and its samples are what its transmittance says.
#include "renderer/rain/rain_medium.h"

#include "renderer/rain/drop_population.h"
#include "renderer/rain/drop_size.h"
#include "tests/statistics.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace pluvia;

namespace {

View level_view() {
    View view;
    view.width = 2048, view.height = 1024, view.focal_pixels = 1991;
    view.position = {0, 2, 0};
    return view;
}

RainSettings all_rain() {
    RainSettings settings;
    settings.intensities_mm_per_h = {1, 10, 50, 100, 400};
    return settings;
}

/// In view direction (x, 0, -1) before normalisation; in these views camera axes are those of the world.
Ray level_ray(float x, float t_max) {
    return {{0, 2, 0}, normalize(Vec3(x, 0, -1)), t_max};
}

}  // namespace

TEST_CASE("what streaks do not cover of the rain's extinction is the medium's, at every depth and width") {
    const View view = level_view();
    for (const double width : {0.25, 1.0})
        for (const float x : {0.0f, 0.6f})
            for (const float end : {0.5f, 3.0f, 20.0f, 45.0f, 300.0f}) {
                RainSettings settings = all_rain();
                settings.min_width_pixels = width;
                const RainMedium medium(view, settings);
                const Ray ray = level_ray(x, end);
                const float cosine = -ray.direction.z;
                const RainSegment segment = medium.segment(ray, cosine);
                REQUIRE(!segment.empty());
                std::vector<float> depths(settings.intensities_mm_per_h.size());
                medium.optical_depths(segment, segment.end, depths.data());
                for (size_t i = 0; i < depths.size(); ++i) {
                    const double intensity = settings.intensities_mm_per_h[i];
                    double expected = 0;
                    constexpr int steps = 4000;
                    const double h = (double(segment.end) - segment.begin) / steps;
                    for (int k = 0; k < steps; ++k) {
                        const double z = (segment.begin + (k + 0.5) * h) * cosine;
                        const double least = std::max(smallest_drop, width * z / view.focal_pixels);
                        expected += h * (extinction(intensity) - extinction(intensity, least, largest_drop));
                    }
                    CAPTURE(intensity);
                    CAPTURE(end);
                    // Linear cells: 1e-3 where extinction sets in, and float.
                    CHECK(depths[i] == doctest::Approx(expected).epsilon(1e-3).scale(1e-4));
                }
            }
}

TEST_CASE("the mean weight of sampled points is what the medium takes away, and no weight is large") {
    const View view = level_view();
    for (const double fog : {0.0, 0.002})
        for (const float end : {0.9f, 5.0f, 40.0f, 200.0f, 2000.0f}) {
            RainSettings settings = all_rain();
            settings.fog_extinction = fog;
            const RainMedium medium(view, settings);
            const Ray ray = level_ray(0.3f, end);
            const RainSegment segment = medium.segment(ray, -ray.direction.z);
            const size_t count = settings.intensities_mm_per_h.size();
            std::vector<float> depths(count);
            medium.optical_depths(segment, segment.end, depths.data());
            std::vector<RunningMean> sums(count);
            RainMedium::Scattering rain, mist;
            float largest = 0;
            for (uint64_t k = 0; k < 20000; ++k) {
                medium.sample(Scatterer::drop, segment, uniform(5, k, 0), rain);
                medium.sample(Scatterer::fog, segment, uniform(5, k, 1), mist);
                CHECK((mist.distance > 0) == (fog > 0));
                REQUIRE(rain.distance > segment.begin);
                REQUIRE(rain.distance <= segment.end * (1 + 1e-6f));
                for (size_t i = 0; i < count; ++i) {
                    sums[i].add(double(rain.weights[i]) + (fog > 0 ? mist.weights[i] : 0));
                    largest = std::max(largest, rain.weights[i]);
                }
            }
            CAPTURE(end);
            for (size_t i = 0; i < count; ++i) {
                CAPTURE(settings.intensities_mm_per_h[i]);
                const double lost = -std::expm1(-double(depths[i]) - medium.fog_depth(segment, segment.end));
                CHECK(sums[i].agrees_with(lost, 1e-5 * lost));  // float
                CHECK(sums[i].standard_error() < 0.02 * lost);
            }
            CHECK(largest < 4);  // of 400 mm/h, 3.2 times the next proposal: 3 * 3.2^0.63 at most would be 6
        }
}

TEST_CASE("rain ends at the surface, the ground, the top of the rain or after two kilometres") {
    const RainMedium medium(level_view(), all_rain());
    const auto end = [&](Vec3 direction, float t_max) {
        const Vec3 d = normalize(direction);
        return medium.segment({{0, 2, 0}, d, t_max}, -d.z).end;
    };
    constexpr float infinity = std::numeric_limits<float>::infinity();
    CHECK(end({0, 0, -1}, 30) == 30);
    CHECK(end({0, 0, -1}, infinity) == 2000);
    CHECK(end({0, 1, -1}, infinity) == doctest::Approx(998 * std::sqrt(2.0)).epsilon(1e-6).scale(0));
    CHECK(end({0, 0.1f, -1}, infinity) == 2000);
    CHECK(end({0, -1, -1}, infinity) == doctest::Approx(2 * std::sqrt(2.0)).epsilon(1e-6).scale(0));
    CHECK(medium.segment({{0, 1200, 0}, {0, 0, -1}}, 1).empty());  // above the rain
    CHECK(!medium.segment({{0, 1200, 0}, normalize(Vec3(0, -1, -1))}, 0.70710678f).empty());
    CHECK(medium.segment({{0, 2, 0}, {0, 0, -1}, 0.05f}, 1).empty());  // nearer than where rain begins
}

TEST_CASE("without drops there is nothing but fog") {
    RainSettings settings = all_rain();
    settings.fog_extinction = 0.01;
    const RainMedium medium(level_view(), settings, false);
    const Ray ray = level_ray(0, 100);
    const RainSegment segment = medium.segment(ray, 1);
    RainMedium::Scattering scattering;
    medium.sample(Scatterer::drop, segment, 0.5f, scattering);
    CHECK(scattering.distance == 0);
    medium.sample(Scatterer::fog, segment, 0.5f, scattering);
    CHECK(scattering.weights[0] == doctest::Approx(1 - std::exp(-0.01 * 99.9)).epsilon(1e-5).scale(0));
}
