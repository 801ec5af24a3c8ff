// Single drops and narrow ranges of drops: times of coverage that follow from Pythagoras.
#include "renderer/rain/coverage.h"
#include "renderer/rain/drop_size.h"
#include "tools/validate/extremes.h"

#include <cmath>
#include <numbers>

namespace pluvia {
namespace {

constexpr float exposure = 1.0f / 60, radius = 1e-3f, near = 0.1f;

double share(const std::optional<Covered>& covered) {
    return covered ? covered->fraction() : 0;
}

}  // namespace

std::vector<ExtremeResult> measure_drop_extremes(bool) {
    std::vector<ExtremeResult> results;
    const Ray axis{{0, 0, 0}, {0, 0, 1}};

    results.push_back({"Dmin = Dmax: extinction", 0, extinction(100, 2e-3, 2e-3), 0});
    const double step = 1e-15, density = marshall_palmer_n0 * std::exp(-size_slope(100) * 2e-3);
    // The step is rounded where it is added to the diameter, so it is taken as it arrives there.
    const double width = (2e-3 + step) - 2e-3;
    results.push_back(relative_result("Dmax - Dmin = 1e-15 m: extinction, cross-section times number",
                                      std::numbers::pi / 4 * 4e-6 * density * width, extinction(100, 2e-3, 2e-3 + step),
                                      1e-3));

    // Falls 0.2 m in the exposure at 12 m/s, from above the axis to below it. Times are stored as fractions of the
    // exposure in single precision: at one half each is known to 6e-8.
    constexpr double rounding = 6e-8;
    const Streak crossing{{0, 0.1f, near}, {0, -12, 0}, radius, 1, 1};
    results.push_back(relative_result("drop of 2 mm at the near limit crosses the axis: 2 r / (v t)",
                                      2 * radius / (12.0 * exposure), share(covered_interval(crossing, axis, exposure)),
                                      rounding / 0.01));
    const Streak far{{0, 0.1f, 1e5f}, {0, -12, 0}, radius, 1, 1};
    results.push_back(relative_result("the same 100 km away", 2 * radius / (12.0 * exposure),
                                      share(covered_interval(far, axis, exposure)), rounding / 0.01));
    const Streak grazing{{radius * 0.9999f, 0.1f, 1}, {0, -12, 0}, radius, 1, 1};
    // 1e-3: the distance from the rim, 1e-4 of the radius, is known to 6e-8 / 1e-4.
    results.push_back(relative_result("drop that passes at 0.9999 of its radius: a chord",
                                      2 * radius * std::sqrt(1 - 0.9999 * 0.9999) / (12.0 * exposure),
                                      share(covered_interval(grazing, axis, exposure)), 1e-3));
    const Streak end_on{{0.0005f, 0, 10}, {0, 0, -12}, radius, 1, 1},
        beside{{0.0011f, 0, 10}, {0, 0, -12}, radius, 1, 1};
    results.push_back(
        {"drop seen end-on, half its radius from the ray", 1, share(covered_interval(end_on, axis, exposure)), 0});
    results.push_back(
        {"drop seen end-on, 1.1 radii from the ray", 0, share(covered_interval(beside, axis, exposure)), 0});
    const Streak still{{0.0005f, 0, 10}, {0, 0, 0}, radius, 1, 1};
    results.push_back({"drop that hangs still", 1, share(covered_interval(still, axis, exposure)), 0});
    const Streak creeping{{0, 0, 10}, {0, 1e-30f, 0}, radius, 1, 1};
    results.push_back({"drop that moves by 1e-30 m/s", 1, share(covered_interval(creeping, axis, exposure)), 0});
    const Streak fast{{0, 500, 10}, {0, -1000, 0}, radius, 1, 1};
    results.push_back(relative_result("exposure of 1 s at 1 km/s", 2 * radius / 1000,
                                      share(covered_interval(fast, axis, 1)), 2 * rounding / 2e-6));
    return results;
}

}  // namespace pluvia
