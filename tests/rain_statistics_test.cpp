// Rain in numbers: published closed forms, and the integrals against the drops that are drawn.
#include "renderer/rain/rain_statistics.h"

#include "renderer/rain/drop_size.h"
#include "tests/statistics.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

using namespace pluvia;

namespace {

View hd_view() {
    View view;
    view.width = 2048, view.height = 1024, view.focal_pixels = 1991;
    return view;
}

}  // namespace

TEST_CASE("water, median drop and visibility are those of Marshall and Palmer's distribution") {
    for (const double intensity : {1.0, 10.0, 50.0}) {
        CAPTURE(intensity);
        const double beta = size_slope(intensity);
        const RainStatistics s = rain_statistics(intensity);
        // Untruncated: pi rho N0 / beta^4 and 3.672 / beta. Above 6 mm there is 0.6 % of the water at 50 mm/h.
        CHECK(s.liquid_water ==
              doctest::Approx(std::numbers::pi * 1000 * 8e6 / std::pow(beta, 4)).epsilon(0.01).scale(0));
        CHECK(s.median_volume_diameter == doctest::Approx(3.672 / beta).epsilon(0.01).scale(0));
        CHECK(s.visibility == doctest::Approx(3.912 / extinction(intensity)).epsilon(1e-4).scale(0));
    }
    CHECK(rain_statistics(50).visibility == doctest::Approx(1825).epsilon(0.01));
    CHECK(rain_statistics(0).drops_per_m3 == 0);
    CHECK(std::isinf(rain_statistics(0).visibility));
}

TEST_CASE("the expected number of streaks is the closed form where no drop is cut off") {
    RainSettings settings;
    settings.min_width_pixels = 1, settings.near = 0.01;
    // W H / f^2 N0 / beta 2 (f / (k beta))^3; cutting at 6 mm loses 1 % of it at 100 mm/h.
    const double beta = size_slope(100);
    const double whole = 0.5290 * 8e6 / beta * 2 * std::pow(1991 / beta, 3);
    CHECK(expected_streaks(hd_view(), settings, 100) == doctest::Approx(whole).epsilon(0.02).scale(0));
}

TEST_CASE("a quarter pixel resolves a seventh of the optical depth of 100 m of heavy rain, and more of what is near") {
    RainSettings settings;
    // Numerical integration of the distribution, apart from this program.
    CHECK(resolved_share(hd_view(), settings, 100, 100) == doctest::Approx(0.153).epsilon(0.03).scale(0));
    CHECK(resolved_share(hd_view(), settings, 10, 100) == doctest::Approx(0.095).epsilon(0.03).scale(0));
    CHECK(resolved_share(hd_view(), settings, 100, 30) == doctest::Approx(0.50).epsilon(0.03));
    CHECK(resolved_share(hd_view(), settings, 100, 0.5) == doctest::Approx(1).epsilon(1e-9));
    settings.min_width_pixels = 1;
    CHECK(resolved_share(hd_view(), settings, 100, 100) == doctest::Approx(0.038).epsilon(0.03).scale(0));
}
