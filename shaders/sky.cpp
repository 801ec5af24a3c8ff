#include "shaders/sky.h"

#include "renderer/core/error.h"
#include "renderer/core/parallel.h"
#include "shaders/night.h"
#include "shaders/sky_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace pluvia {
namespace {

constexpr double pi_d = std::numbers::pi;

using Picture = Image<Rgb>;

double row_elevation(const Picture& picture, int y) {
    return pi_d * (0.5 - (y + 0.5) / picture.height);
}
double column_azimuth(const Picture& picture, int x) {
    return 2 * pi_d * ((x + 0.5) / picture.width - 0.25);
}

/// A body that lights the atmosphere: the sun or the moon.
struct Body {
    double elevation, azimuth;
    double scale;  // of the sun's light at 1 AU, luminance
    Bands color = Bands(1);
    double radius;
    float limb_darkening = 0;
    Vec3 lit_from = {};
    double lit_part = 1;  // of the disc
    bool lights_air = true;
};

Body sun_of(const SkySettings& s) {
    constexpr double radius_at_1_au = 0.2666 * pi_d / 180;
    // Limb darkening in the middle of the visible spectrum.
    return {s.sun_elevation,
            s.sun_azimuth,
            1 / (s.sun_distance * s.sun_distance),
            Bands(1),
            radius_at_1_au / s.sun_distance,
            0.6f};
}

Body moon_of(const Moon& m, const SkySettings& s) {
    Body body{m.elevation, m.azimuth, moon_over_sun(m.phase_angle, m.parallax), moon_reddening(),
              moon_radius(m.parallax)};
    body.lit_from = Vec3(direction_from_azimuth(s.sun_azimuth, s.sun_elevation));
    // By day its light in the air is less than a ten thousandth of the sun's; its disc is seen all the same.
    constexpr double day = 0.17;
    body.lights_air = s.sun_elevation < day;
    return body;
}

/// Black where the disc is below the horizon or behind closed cloud.
Disc disc_of(const SkyTables& tables, const Body& body, double passed_by_clouds) {
    constexpr int strips = 32;  // so that a disc sets bit by bit
    Disc disc;
    disc.direction = Vec3(direction_from_azimuth(body.azimuth, body.elevation));
    disc.angular_radius = float(body.radius);
    disc.limb_darkening = body.limb_darkening;
    disc.lit_from = body.lit_from;
    double shining = 1;  // part of the disc
    if (!(disc.lit_from == Vec3())) {
        disc.strips = {Rgb(1)};
        shining = disc.mean_radiance().g;
        constexpr double thinnest = 1e-3;  // of a crescent that quadrature finds
        if (shining < thinnest) shining = 1, disc.lit_from = {};
    }
    disc.strips.assign(strips, Rgb(0));
    const double scale = passed_by_clouds * body.scale / (disc.solid_angle() * shining);
    if (scale == 0) return disc;
    for (int i = 0; i < strips; ++i) {
        const double elevation = body.elevation + body.radius * ((i + 0.5) * 2 / strips - 1);
        const Bands light = direct_transmittance(tables, elevation) * body.color;
        disc.strips[size_t(i)] = rec709_from_xyz(xyz_from_bands(light * float(scale)));
    }
    return disc;
}

/// Rgb factor for light of the sun's colour that is to have the body's.
Rgb tint_of(const Body& body) {
    const Rgb sun = rec709_from_xyz(xyz_from_bands(Bands(1))), c = rec709_from_xyz(xyz_from_bands(body.color));
    return {c.r / sun.r, c.g / sun.g, c.b / sun.b};
}

void add_view(Picture& picture, const SkyTables& tables, const Body& body) {
    const SkyView view(tables, body.elevation);
    const Rgb tint = tint_of(body) * float(body.scale);
    parallel_for(picture.height / 2, [&](int y) {
        for (int x = 0; x < picture.width; ++x)
            picture.at(x, y) +=
                view.radiance(row_elevation(picture, y), column_azimuth(picture, x) - body.azimuth) * tint;
    });
}

/// Irradiance by the upper half of the picture on a horizontal surface.
Rgb sky_irradiance(const Picture& picture) {
    double r = 0, g = 0, b = 0;
    for (int y = 0; y < picture.height / 2; ++y) {
        const double top = std::cos(pi_d * y / picture.height), bottom = std::cos(pi_d * (y + 1) / picture.height);
        const double weight = (top * top - bottom * bottom) * (pi_d / picture.width);
        for (int x = 0; x < picture.width; ++x) {
            const Rgb c = picture.at(x, y);
            r += c.r * weight, g += c.g * weight, b += c.b * weight;
        }
    }
    return {float(r), float(g), float(b)};
}

Rgb horizontal_irradiance(const Disc& disc) {
    return disc.mean_radiance() * (disc.solid_angle() * std::max(0.0f, disc.direction.y));
}

void add_row(Picture& picture, int y, Rgb radiance) {
    for (int x = 0; x < picture.width; ++x) picture.at(x, y) += radiance;
}

/// Replaces a part of the clear sky by overcast of the given irradiance.
void add_clouds(Picture& picture, double cover, Rgb irradiance) {
    Picture overcast(picture.width, picture.height);
    for (int y = 0; y < picture.height / 2; ++y)
        add_row(overcast, y, Rgb(float(overcast_luminance(std::sin(row_elevation(picture, y))))));
    // By the picture's own integral, so that the wanted illuminance is met to rounding.
    const Rgb scale = irradiance / luminance(sky_irradiance(overcast));
    for (int y = 0; y < picture.height / 2; ++y)
        for (int x = 0; x < picture.width; ++x)
            picture.at(x, y) = picture.at(x, y) * float(1 - cover) + overcast.at(x, y) * scale;
}

void require(bool ok, const char* what, double got, const char* expected) {
    if (!ok)
        throw usage_error(
            "sky", std::string(what) + " is out of range (got " + std::to_string(got) + ", expected " + expected + ")");
}

void check(const SkySettings& s) {
    const auto is_elevation = [](double e) { return std::abs(e) <= pi_d / 2 + 1e-9; };
    require(is_elevation(s.sun_elevation), "sun elevation", s.sun_elevation, "-pi/2 to pi/2 radians");
    require(std::isfinite(s.sun_azimuth), "sun azimuth", s.sun_azimuth, "a finite angle");
    require(s.sun_distance > 0.5 && s.sun_distance < 2, "distance of the sun", s.sun_distance, "0.5 to 2 AU");
    require(s.clouds.cover >= 0 && s.clouds.cover <= 1, "cloud cover", s.clouds.cover, "0 to 1");
    require(s.clouds.transmittance > 0 && s.clouds.transmittance <= 1, "transmittance of cloud", s.clouds.transmittance,
            "above 0, up to 1");
    require(s.city_glow >= 0 && s.city_glow <= 100, "city glow", s.city_glow, "0 to 100 cd/m2");
    require(s.texels >= 2 && s.texels <= 8192 && s.texels % 2 == 0, "number of texels", s.texels,
            "an even number, 2 to 8192");
    if (!s.moon) return;
    require(is_elevation(s.moon->elevation), "moon elevation", s.moon->elevation, "-pi/2 to pi/2 radians");
    require(std::isfinite(s.moon->azimuth), "moon azimuth", s.moon->azimuth, "a finite angle");
}

}  // namespace

Environment make_sky(const SkyTables& tables, const SkySettings& settings) {
    check(settings);
    Picture picture(settings.texels, settings.texels);
    for (int y = 0; y < picture.height / 2; ++y)
        add_row(picture, y, night_sky_radiance(tables, row_elevation(picture, y)));

    std::vector<Body> bodies;
    // Below these heights the body's light is less than a thousandth of the night sky's.
    constexpr double last_sunlight = -0.35, last_moonlight = -0.14;
    if (settings.sun_elevation > last_sunlight) bodies.push_back(sun_of(settings));
    if (settings.moon && settings.moon->elevation > last_moonlight) bodies.push_back(moon_of(*settings.moon, settings));
    std::vector<Disc> discs;
    Rgb direct, clear_direct;
    for (const Body& body : bodies) {
        if (body.lights_air) add_view(picture, tables, body);
        const Disc clear = disc_of(tables, body, 1);
        clear_direct += horizontal_irradiance(clear);
        discs.push_back(disc_of(tables, body, disc_ratio(settings.clouds)));
        direct += horizontal_irradiance(discs.back());
    }
    const Clouds& clouds = settings.clouds;
    if (clouds.cover > 0) {
        const Rgb clear_sky = sky_irradiance(picture), clear = clear_sky + clear_direct;
        const double wanted = illuminance_ratio(clouds) * luminance(clear);
        const double missing = wanted - luminance(direct) - (1 - clouds.cover) * luminance(clear_sky);
        add_clouds(picture, clouds.cover, cloud_color(clear, settings.sun_elevation) * float(std::max(0.0, missing)));
    }
    for (int y = 0; settings.city_glow > 0 && y < picture.height / 2; ++y)
        add_row(picture, y, city_glow_radiance(settings.city_glow, clouds.cover, row_elevation(picture, y)));

    const Rgb ground = (sky_irradiance(picture) + direct) * float(tables.atmosphere.settings.ground_albedo / pi_d);
    for (int y = picture.height / 2; y < picture.height; ++y) add_row(picture, y, ground);
    return Environment(std::move(picture), discs);
}

}  // namespace pluvia
