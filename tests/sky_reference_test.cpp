// The clear sky against brute force: paths of light through the spherical atmosphere, from the eye backwards, with the
// full phase functions, any number of scatterings and no table but that of columns (tested in sky_tables_test.cpp).
#include "shaders/sky_view.h"

#include "renderer/core/parallel.h"
#include "renderer/core/units.h"
#include "tests/skies.h"
#include "tests/statistics.h"

#include <doctest/doctest.h>

#include <numbers>

namespace pluvia {
namespace {

constexpr double pi_d = std::numbers::pi;

/// One path's random numbers, in the order in which they are asked for.
class Chances {
public:
    Chances(uint64_t seed, uint64_t path) : key_(hash_key(seed, path)) {}
    double next() {
        key_ = mix_bits(key_ + 0x9e3779b97f4a7c15ull);
        return double(key_ >> 11) * 0x1p-53;
    }

private:
    uint64_t key_;
};

Vec3d around(Vec3d axis, double cosine, double azimuth) {
    const Vec3d helper = std::abs(axis.x) < 0.5 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
    const Vec3d x = normalize(cross(axis, helper)), y = cross(axis, x);
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    return axis * cosine + x * (sine * std::cos(azimuth)) + y * (sine * std::sin(azimuth));
}

class Reference {
public:
    Reference(const SkyTables& tables, double sun_elevation, int band)
        : tables_(tables),
          a_(tables.atmosphere),
          band_(band),
          sun_{std::cos(sun_elevation), 0, std::sin(sun_elevation)},
          majorant_(extinction({1, 1, 0}) * 1.0001) {}

    /// Scattered radiance per unit of solar irradiance from a direction, one path.
    double radiance(Vec3d direction, Chances& chances) const {
        Vec3d p{0, 0, a_.ground_radius + 1e-3};
        double weight = 1, sum = 0;
        for (;;) {
            const double r = length(p), mu = dot(p, direction) / r;
            const bool ground = hits_ground(a_, r, mu);
            const double end = ground ? distance_to_ground(a_, r, mu) : distance_to_top(a_, r, mu);
            double t = 0;
            Atmosphere::Amounts d;
            bool collides = false;
            while (!collides) {  // Woodcock tracking
                t -= std::log1p(-chances.next()) / majorant_;
                if (t >= end) break;
                d = a_.density(length(p + direction * t) - a_.ground_radius);
                collides = chances.next() * majorant_ < extinction(d);
            }
            if (!collides && !ground) return sum;
            if (!collides) {
                p = normalize(p + direction * end) * (a_.ground_radius + 1e-3);
                const Vec3d up = normalize(p);
                weight *= a_.settings.ground_albedo;
                sum += weight / pi_d * std::max(0.0, dot(up, sun_)) * sunlight(p);
                direction = around(up, std::sqrt(chances.next()), 2 * pi_d * chances.next());
            } else {
                p = p + direction * t;
                const double air = a_.air_scattering[band_] * d.air, haze = a_.aerosol_scattering[band_] * d.aerosol;
                weight *= (air + haze) / extinction(d);
                const double nu = dot(direction, sun_), g = a_.settings.asymmetry;
                sum += weight * sunlight(p) *
                       (air * rayleigh_phase(float(nu)) + haze * aerosol_phase(float(nu), float(g))) / (air + haze);
                direction = around(
                    direction, chances.next() * (air + haze) < air ? rayleigh_cosine(chances) : haze_cosine(g, chances),
                    2 * pi_d * chances.next());
            }
            if (weight < 0.1) {
                if (chances.next() < 0.5) return sum;
                weight *= 2;
            }
        }
    }

private:
    double extinction(const Atmosphere::Amounts& d) const { return a_.depth(d)[band_]; }
    double sunlight(Vec3d p) const {
        const double r = std::max(length(p), a_.ground_radius + 1e-3), mu = dot(p, sun_) / length(p);
        return hits_ground(a_, r, mu) ? 0 : std::exp(-a_.depth(tables_.columns.to_space(r, mu))[band_]);
    }
    static double rayleigh_cosine(Chances& chances) {
        for (;;) {
            const double cosine = 2 * chances.next() - 1;
            if (2 * chances.next() < 1 + cosine * cosine) return cosine;
        }
    }
    static double haze_cosine(double g, Chances& chances) {
        const double s = (1 - g * g) / (1 - g + 2 * g * chances.next());
        return (1 + g * g - s * s) / (2 * g);
    }

    const SkyTables& tables_;
    const Atmosphere& a_;
    int band_;
    Vec3d sun_;
    double majorant_;
};

/// tolerance_*: how far the model may be from the truth; the reference's own error comes on top with five sigma.
void compare(const std::vector<double>& sun_elevations, int paths, double tolerance_irradiance,
             double tolerance_zenith) {
    const SkyTables& tables = standard_sky_tables();
    const std::vector<int> tested = {2, 5, 9};  // 459, 541 and 651 nm
    const int count = int(sun_elevations.size() * tested.size());
    std::vector<RunningMean> irradiance(static_cast<size_t>(count)), zenith(static_cast<size_t>(count));
    parallel_for(2 * count, [&](int job) {
        const int i = job / 2;
        const double sun = radians_from_degrees(sun_elevations[size_t(i) / tested.size()]);
        const Reference reference(tables, sun, tested[size_t(i) % tested.size()]);
        for (int path = 0; path < paths; ++path) {
            Chances chances(uint64_t(1000 + job), uint64_t(path));
            if (job % 2 == 0) {
                const double cosine = std::sqrt(chances.next());
                const Vec3d direction = around({0, 0, 1}, cosine, 2 * pi_d * chances.next());
                irradiance[size_t(i)].add(pi_d * reference.radiance(direction, chances));
            } else {
                zenith[size_t(i)].add(reference.radiance({0, 0, 1}, chances));
            }
        }
    });
    for (int i = 0; i < count; ++i) {
        const double elevation = sun_elevations[size_t(i) / tested.size()], sun = radians_from_degrees(elevation);
        const int band = tested[size_t(i) % tested.size()];
        const double r = tables.atmosphere.ground_radius + 1e-3;
        const double up = scattered_radiance(tables, r, 1, std::sin(sun), std::sin(sun))[band];
        double level = 0;
        constexpr int rings = 48, azimuths = 24;
        for (int k = 0; k < rings; ++k)
            for (int a = 0; a < azimuths; ++a) {
                const double mu = std::sqrt((k + 0.5) / rings), azimuth = pi_d * (a + 0.5) / azimuths;
                const double nu = mu * std::sin(sun) + std::sqrt(1 - mu * mu) * std::cos(sun) * std::cos(azimuth);
                level += pi_d / (rings * azimuths) * scattered_radiance(tables, r, mu, std::sin(sun), nu)[band];
            }
        const RunningMean& e = irradiance[size_t(i)];
        const RunningMean& z = zenith[size_t(i)];
        CAPTURE(elevation);
        CAPTURE(band);
        MESSAGE("sun " << elevation << " band " << band << ": irradiance " << level / e.mean() << " +- "
                       << e.standard_error() / e.mean() << ", zenith " << up / z.mean() << " +- "
                       << z.standard_error() / z.mean());
        CHECK(e.agrees_with(level, tolerance_irradiance * e.mean()));
        CHECK(z.agrees_with(up, tolerance_zenith * z.mean()));
    }
}

}  // namespace

TEST_CASE("the sky's light agrees with brute force by day and after sunset") {
    compare({60, 10, -2}, 40000, 0.10, 0.12);
}

// Takes minutes; see tests/CMakeLists.txt.
TEST_CASE("the sky's light agrees closely with brute force" * doctest::skip()) {
    compare({60, 30, 10, 2, -2}, 1000000, 0.10, 0.12);
}

TEST_CASE("finer tables change the light by less than the model is good for" * doctest::skip()) {
    const SkyTables& tables = standard_sky_tables();
    const SkyTables fine = make_sky_tables(
        {}, {.heights = 64, .suns = 256, .directions = 24, .azimuths = 12, .steps = 48, .max_orders = 12});
    const auto level = [](const SkyTables& t, double sun) {
        const SkyView view(t, sun);
        double sum = 0;
        for (int i = 0; i < 256; ++i)
            for (int a = 0; a < 128; ++a) {
                const double elevation = 0.5 * pi_d * (i + 0.5) / 256;
                sum += luminance(view.radiance(elevation, pi_d * (a + 0.5) / 128)) * std::sin(2 * elevation);
            }
        return sum;
    };
    for (const double elevation : {90.0, 60.0, 30.0, 10.0, 2.0, 0.0, -2.0, -4.0, -6.0, -8.0, -10.0}) {
        const double sun = radians_from_degrees(elevation), ratio = level(fine, sun) / level(tables, sun);
        CAPTURE(elevation);
        CAPTURE(ratio);
        CHECK(std::abs(ratio - 1) < (elevation >= 0 ? 0.03 : 0.10));
    }
}

}  // namespace pluvia
