// The clear atmosphere against quadrature, energy and symmetry, and its tables against finer ones and damaged files.
// Published illuminances are in sky_test.cpp, brute force in sky_reference_test.cpp.
#include "shaders/sky_view.h"

#include "renderer/core/parallel.h"
#include "renderer/core/units.h"
#include "renderer/image/table_file.h"
#include "tests/skies.h"
#include "tests/temporary_folder.h"

#include <doctest/doctest.h>

#include <cstring>
#include <ctime>
#include <numbers>

namespace pluvia {
namespace {

constexpr double pi_d = std::numbers::pi;

/// Coarse tables for tests whose question does not need fine ones.
constexpr ScatteringSize small_size = {
    .heights = 12, .suns = 48, .directions = 8, .azimuths = 4, .steps = 16, .max_orders = 6};

/// Optical depth of the way from a point to the top of the atmosphere by the midpoint rule, one band, without tables.
double depth_to_space(const Atmosphere& atmosphere, double r, double mu, int band) {
    constexpr int steps = 400;
    const double length = distance_to_top(atmosphere, r, mu);
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double a = length * i * i / (double(steps) * steps),
                     b = length * (i + 1) * (i + 1) / (double(steps) * steps);
        const double t = 0.5 * (a + b), here = std::sqrt(r * r + t * t + 2 * r * mu * t);
        sum += atmosphere.depth(atmosphere.density(here - atmosphere.ground_radius))[band] * (b - a);
    }
    return sum;
}

/// Light scattered once, by the midpoint rule in even steps.
double single_scattering(const Atmosphere& atmosphere, double mu, double mu_s, double nu, int band) {
    constexpr int steps = 3000;
    const double r = atmosphere.ground_radius + 1e-3, length = distance_to_top(atmosphere, r, mu), dt = length / steps;
    double depth = 0, sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double t = (i + 0.5) * dt, here = std::sqrt(r * r + t * t + 2 * r * mu * t);
        const double sun = (r * mu_s + t * nu) / here;
        const Atmosphere::Amounts d = atmosphere.density(here - atmosphere.ground_radius);
        const double extinction = atmosphere.depth(d)[band];
        depth += 0.5 * extinction * dt;
        if (!hits_ground(atmosphere, here, sun)) {
            const double source = atmosphere.air_scattering[band] * d.air * rayleigh_phase(float(nu)) +
                                  atmosphere.aerosol_scattering[band] * d.aerosol *
                                      aerosol_phase(float(nu), float(atmosphere.settings.asymmetry));
            sum += std::exp(-depth - depth_to_space(atmosphere, here, sun, band)) * source * dt;
        }
        depth += 0.5 * extinction * dt;
    }
    return sum;
}

/// Gauss-like even nodes are enough for smooth integrands.
double mean_flux_out(const SkyTables& tables, double mu_s) {
    const Atmosphere& atmosphere = tables.atmosphere;
    const double r = atmosphere.top_radius, horizon = -std::sqrt(1 - std::pow(atmosphere.ground_radius / r, 2));
    constexpr int rings = 24, azimuths = 12;
    double sum = 0;
    for (const auto& [from, to] : {std::pair{-1.0, horizon}, std::pair{horizon, 0.0}})
        for (int i = 0; i < rings; ++i)
            for (int a = 0; a < azimuths; ++a) {
                const double mu = from + (to - from) * (i + 0.5) / rings, azimuth = pi_d * (a + 0.5) / azimuths;
                const double nu = mu * mu_s + std::sqrt((1 - mu * mu) * (1 - mu_s * mu_s)) * std::cos(azimuth);
                sum += luminance_from_bands(scattered_radiance(tables, r, mu, mu_s, nu)) * -mu * (to - from) / rings *
                       (2 * pi_d / azimuths);
            }
    return sum;
}

}  // namespace

TEST_CASE("light scattered once agrees with quadrature along the ray") {
    AtmosphereSettings settings;
    settings.forward_fraction = 0;  // nothing is moved out of the phase function
    ScatteringSize none = small_size;
    none.max_orders = 0;
    const SkyTables tables = make_sky_tables(settings, none);
    constexpr double view_elevations[] = {1, 10, 30, 60, 90}, sun_elevations[] = {60, 20, 3, -3};
    parallel_for(20, [&](int i) {
        const double view = radians_from_degrees(view_elevations[i % 5]);
        const double sun = radians_from_degrees(sun_elevations[i / 5]), azimuth = 0.5 * (i % 5);
        const double mu = std::sin(view), mu_s = std::sin(sun);
        const double nu = mu * mu_s + std::cos(view) * std::cos(sun) * std::cos(azimuth);
        const Bands found = scattered_radiance(tables, tables.atmosphere.ground_radius + 1e-3, mu, mu_s, nu);
        for (const int band : {2, 6}) {
            const double expected = single_scattering(tables.atmosphere, mu, mu_s, nu, band);
            CAPTURE(i);
            // 3 %: steps of the small tables, 2.4 % where the sun is below the horizon.
            CHECK(found[band] == doctest::Approx(expected).scale(0).epsilon(0.03));
        }
    });
}

TEST_CASE("light scattered once in Cycles' atmosphere is that of Cycles' Nishita sky") {
    // Cycles 3.4.1, defaults, disc off: luminance of the zenith and illuminance of the sky, 683 times its W/m2.
    struct Seen {
        double elevation, zenith, illuminance;
    };
    const Seen seen[] = {{60, 1670, 6448}, {40, 976, 6042}, {20, 641, 5043}, {10, 477, 3798},
                         {5, 343, 2603},   {2, 216, 1535},  {0, 114, 748.9}};
    AtmosphereSettings theirs;
    theirs.planet_radius = 6360, theirs.top_height = 60;
    theirs.air = {{0, 1}, {60, std::exp(-60.0 / 8)}};
    theirs.rayleigh_height = 8, theirs.ground_albedo = 0, theirs.forward_fraction = 0;
    theirs.aerosol_albedo = 1 / 1.11, theirs.angstrom_exponent = 0, theirs.beta = 0.02 * 1.11 * theirs.aerosol_height;
    ScatteringSize none = small_size;
    none.max_orders = 0;
    const SkyTables tables = make_sky_tables(theirs, none);
    // Its sun has another spectrum: without ozone, which its disc lacks, and without the fifth that its limb darkening
    // takes, it gives 111.5 klx from the zenith where ours gives 117.5.
    constexpr double spectrum = 111.5 / 117.5;
    for (const Seen& s : seen) {
        const double sun = radians_from_degrees(s.elevation), r = theirs.planet_radius + 1e-3;
        const double zenith = luminance_from_bands(scattered_radiance(tables, r, 1, std::sin(sun), std::sin(sun)));
        double illuminance = 0;
        constexpr int rings = 48, azimuths = 24;
        for (int k = 0; k < rings; ++k)
            for (int a = 0; a < azimuths; ++a) {
                const double mu = std::sqrt((k + 0.5) / rings);
                const double nu =
                    mu * std::sin(sun) + std::sqrt(1 - mu * mu) * std::cos(sun) * std::cos(pi_d * (a + 0.5) / azimuths);
                illuminance += pi_d / (rings * azimuths) *
                               luminance_from_bands(scattered_radiance(tables, r, mu, std::sin(sun), nu));
            }
        CAPTURE(s.elevation);
        CHECK(zenith * spectrum == doctest::Approx(s.zenith).scale(0).epsilon(0.05));
        CHECK(illuminance * spectrum == doctest::Approx(s.illuminance).scale(0).epsilon(0.05));
    }
}

TEST_CASE("an atmosphere that absorbs nothing sends back all light that meets it") {
    AtmosphereSettings settings;
    settings.aerosol_albedo = 1, settings.ozone_dobson = 0, settings.ground_albedo = 1;
    const SkyTables tables = make_sky_tables(
        settings, {.heights = 24, .suns = 64, .directions = 12, .azimuths = 6, .steps = 24, .max_orders = 80});
    // Mean over the planet: all cosines of the sun are equally frequent.
    constexpr int suns = 40;
    std::vector<double> out(suns);
    parallel_for(suns, [&](int i) { out[size_t(i)] = mean_flux_out(tables, -0.3 + 1.3 * (i + 0.5) / suns); });
    double mean = 0;
    for (const double flux : out) mean += flux * (1.3 / suns) / 2;
    // What meets the disc of the planet with its air, without what passes through the air beside the ground.
    const Atmosphere& atmosphere = tables.atmosphere;
    double passed = 0;
    constexpr int rings = 400;
    for (int i = 0; i < rings; ++i) {
        const double width = (atmosphere.top_radius - atmosphere.ground_radius) / rings;
        const double r = atmosphere.ground_radius + (i + 0.5) * width;
        const Bands through = exp_minus(atmosphere.depth(tables.columns.to_space(r, 0)) * 2);
        passed += luminance_from_bands(through) * 2 * pi_d * r * width;
    }
    const double met = luminance_from_bands(Bands(1)) * pi_d * atmosphere.top_radius * atmosphere.top_radius - passed;
    const double area = 4 * pi_d * atmosphere.top_radius * atmosphere.top_radius;
    MESSAGE("sent back: " << mean / (met / area));
    CHECK(
        mean ==
        doctest::Approx(met / area).scale(0).epsilon(0.03));  // quadrature, and the peak's shape after many scatterings
}

TEST_CASE("the sky is the same on both sides of the sun") {
    const SkyView view(standard_sky_tables(), 0.2);
    for (const double elevation : {0.0, 0.01, 0.3, 1.2})
        for (const double azimuth : {0.0, 0.1, 1.0, 2.9, 3.14159})
            CHECK(view.radiance(elevation, azimuth) == view.radiance(elevation, -azimuth));
}

TEST_CASE("no radiance is negative or not finite, at any height, in clean air and in thick haze") {
    for (const double beta : {0.0, 0.1, 1.0}) {
        AtmosphereSettings settings;
        settings.beta = beta;
        const SkyTables tables = make_sky_tables(settings, small_size);
        for (const double degrees : {-90.0, -18.0, -0.2666, 0.0, 0.2666, 90.0}) {
            const double sun = radians_from_degrees(degrees);
            for (const double altitude : {0.0, 1e-3, 5.0}) {
                const double r = tables.atmosphere.ground_radius + std::max(altitude, 1e-3);
                for (const double elevation : {-pi_d / 2, -0.05, -1e-6, 0.0, 1e-6, 0.3, pi_d / 2})
                    for (int a = 0; a <= 4; ++a) {
                        const double nu = std::sin(elevation) * std::sin(sun) +
                                          std::cos(elevation) * std::cos(sun) * std::cos(a * pi_d / 4);
                        const Bands light = scattered_radiance(tables, r, std::sin(elevation), std::sin(sun),
                                                               std::clamp(nu, -1.0, 1.0));
                        CAPTURE(beta);
                        CAPTURE(degrees);
                        CAPTURE(elevation);
                        for (int k = 0; k < band_count; ++k) CHECK((std::isfinite(light[k]) && light[k] >= 0));
                    }
            }
            const SkyView view(tables, sun);
            for (const Rgb& c : view.values())
                if (!(is_finite(c) && std::min({c.r, c.g, c.b}) >= 0)) FAIL_CHECK("bad texel at sun " << degrees);
        }
    }
}

TEST_CASE("exponentials of bands are exact to single precision") {
    for (double x = 0; x < 80; x += 0.37) {
        const Bands e = exp_minus(Bands(float(x)));
        CHECK(e[7] == doctest::Approx(std::exp(-double(float(x)))).scale(0).epsilon(4e-7));
        const double mean = x > 0 ? -std::expm1(-double(float(x))) / float(x) : 1;
        CHECK(mean_transmittance(Bands(float(x)), e)[3] == doctest::Approx(mean).scale(0).epsilon(4e-6));
    }
    const Bands small = mean_transmittance(Bands(1e-6f), exp_minus(Bands(1e-6f)));
    CHECK(small[0] == doctest::Approx(1 - 0.5e-6).scale(0).epsilon(1e-7));
}

TEST_CASE("tables have the same bytes for any number of threads") {
    std::vector<float> parallel, serial;
    const auto make = [] { return values_of(make_sky_tables({}, small_size)); };
    parallel = make();
    run_serially([&] { serial = make(); });
    REQUIRE(parallel.size() == serial.size());
    CHECK(std::memcmp(parallel.data(), serial.data(), parallel.size() * sizeof(float)) == 0);
}

TEST_CASE("tables and a sky take no more time than a render should wait for") {
    // Processor time, which the machine's other work does not change much; twice the tables' 4 s on two cores.
    const std::clock_t start = std::clock();
    const SkyTables tables = make_sky_tables();
    const std::clock_t built = std::clock();
    const SkyView view(tables, 0.3);
    const std::clock_t seen = std::clock();
    CHECK(view.values().size() > 0);
    MESSAGE("tables " << double(built - start) / CLOCKS_PER_SEC << " s, view " << double(seen - built) / CLOCKS_PER_SEC
                      << " s of processor time");
#if defined(__OPTIMIZE__) && !defined(__SANITIZE_ADDRESS__)
    CHECK(double(built - start) / CLOCKS_PER_SEC < 8);
    CHECK(double(seen - built) / CLOCKS_PER_SEC < 0.6);
#endif
}

TEST_CASE("cached tables are the made ones, and whatever is wrong with the file they are made again") {
    const TemporaryFolder folder;
    AtmosphereSettings settings;
    settings.beta = 0.06;  // nobody else's file
    const std::string cache = folder / "new/pluvia";
    const std::vector<float> made = values_of(cached_sky_tables(settings, cache));
    std::string path;
    for (const auto& entry : std::filesystem::directory_iterator(cache)) path = entry.path();
    const std::string bytes = read_file(path);
    const uint64_t key = sky_tables_key(settings);
    const size_t count = sky_value_count();
    CHECK(values_of(cached_sky_tables(settings, cache)) == made);
    CHECK(read_table(path, key, count) == made);

    CHECK_FALSE(read_table(path, key + 1, count));
    CHECK_FALSE(read_table(path, key, count - 1));
    CHECK_FALSE(read_table(folder / "absent", key, count));
    std::string damaged = bytes;
    damaged[damaged.size() / 2] ^= 1;
    for (const std::string& content : {damaged, bytes.substr(0, bytes.size() - 1), bytes + "x", std::string()}) {
        write_file(path, content);
        CHECK_FALSE(read_table(path, key, count));
    }
    write_file(path, damaged);
    CHECK(values_of(cached_sky_tables(settings, cache)) == made);
    CHECK(read_file(path) == bytes);  // written anew

    CHECK_FALSE(write_table("/proc/nowhere/table", key, made));
    write_file(folder / "file", "");
    CHECK(values_of(cached_sky_tables(settings, folder / "file/pluvia")) == made);
    CHECK(values_of(cached_sky_tables(settings, "")) == made);
}

TEST_CASE("the cache is where the desktop standard has it") {
    const auto value = [](const char* name) { return std::string(std::getenv(name) ? std::getenv(name) : ""); };
    const std::string cache = value("XDG_CACHE_HOME"), home = value("HOME");
    setenv("XDG_CACHE_HOME", "/a/cache", 1), setenv("HOME", "/a/home", 1);
    CHECK(cache_folder() == "/a/cache/pluvia");
    setenv("XDG_CACHE_HOME", "relative", 1);
    CHECK(cache_folder() == "/a/home/.cache/pluvia");
    unsetenv("XDG_CACHE_HOME");
    CHECK(cache_folder() == "/a/home/.cache/pluvia");
    unsetenv("HOME");
    CHECK(cache_folder().empty());
    if (!cache.empty()) setenv("XDG_CACHE_HOME", cache.c_str(), 1);
    if (!home.empty()) setenv("HOME", home.c_str(), 1);
}

}  // namespace pluvia
