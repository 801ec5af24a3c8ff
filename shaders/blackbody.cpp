#include "shaders/blackbody.h"

#include <cmath>

namespace pluvia {
namespace {

constexpr double coldest = 1000, hottest = 100000;

double lobe(double wavelength, double centre, double below, double above) {
    const double t = (wavelength - centre) / (wavelength < centre ? below : above);
    return std::exp(-0.5 * t * t);
}

Xyz blackbody_xyz(double temperature) {
    constexpr double second_radiation_constant = 1.438777e7;  // nm K
    Xyz sum;
    for (double l = 380; l <= 780; l += 5) {
        const double power = std::pow(l / 560, -5) / std::expm1(second_radiation_constant / (l * temperature));
        sum.x += power * (1.056 * lobe(l, 599.8, 37.9, 31.0) + 0.362 * lobe(l, 442.0, 16.0, 26.7) -
                          0.065 * lobe(l, 501.1, 20.4, 26.2));
        sum.y += power * (0.821 * lobe(l, 568.8, 46.9, 40.5) + 0.286 * lobe(l, 530.9, 16.3, 31.1));
        sum.z += power * (1.217 * lobe(l, 437.0, 11.8, 36.0) + 0.681 * lobe(l, 459.0, 26.0, 13.8));
    }
    return {sum.x / sum.y, 1, sum.z / sum.y};
}

struct Uv {
    double u, v;
};
Uv uv_of(const Xyz& c) {
    const double d = c.x + 15 * c.y + 3 * c.z;
    return {4 * c.x / d, 6 * c.y / d};
}

}  // namespace

Rgb blackbody_color(double temperature) {
    const Rgb c = rec709_from_xyz(blackbody_xyz(temperature));
    return c / luminance(c);
}

std::optional<double> color_temperature(Rgb light) {
    if (!(luminance(light) > 0)) return std::nullopt;
    const Uv wanted = uv_of(xyz_from_rec709(light));
    const auto distance = [&](double mired) {
        const Uv here = uv_of(blackbody_xyz(1e6 / mired));
        return std::hypot(here.u - wanted.u, here.v - wanted.v);
    };
    // Golden section over mired, in which the locus is nearly evenly spaced.
    double low = 1e6 / hottest, high = 1e6 / coldest;
    constexpr double golden = 0.6180339887;
    double a = high - golden * (high - low), b = low + golden * (high - low);
    double at_a = distance(a), at_b = distance(b);
    for (int i = 0; i < 40; ++i) {
        if (at_a < at_b) {
            high = b, b = a, at_b = at_a;
            at_a = distance(a = high - golden * (high - low));
        } else {
            low = a, a = b, at_a = at_b;
            at_b = distance(b = low + golden * (high - low));
        }
    }
    const double mired = 0.5 * (low + high);
    if (mired < 1e6 / hottest + 0.01) return std::nullopt;
    return 1e6 / mired;
}

}  // namespace pluvia
