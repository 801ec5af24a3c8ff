#include "renderer/core/error.h"
#include "renderer/core/units.h"
#include "renderer/image/color.h"
#include "shaders/blackbody.h"
#include "tools/commands.h"
#include "tools/light_options.h"
#include "tools/option_check.h"
#include "tools/sky_cache.h"
#include "tools/sky_pictures.h"

#include <iostream>
#include <memory>
#include <numbers>

namespace pluvia {
namespace {

using Json = nlohmann::ordered_json;

struct SkyOptions {
    LightOptions light;
    std::string output, exposure = "auto", view = "filmic";
    bool strip = false, json = false;
};

double degrees(double radians) {
    return radians * (180 / std::numbers::pi);
}

/// Light of the discs on the horizontal.
Rgb direct_irradiance(const Environment& sky) {
    Rgb sum;
    for (const Disc& disc : sky.discs())
        sum += disc.mean_radiance() * (disc.solid_angle() * std::max(0.0f, disc.direction.y));
    return sum;
}

/// All light on the horizontal, from the picture's upper half.
Rgb horizontal_irradiance(const Image<Rgb>& picture) {
    double r = 0, g = 0, b = 0;
    for (int y = 0; y < picture.height / 2; ++y) {
        const double elevation = std::numbers::pi * (0.5 - (y + 0.5) / picture.height),
                     step = std::numbers::pi / picture.height;
        const double weight = std::sin(elevation) * std::cos(elevation) * step * step;
        for (int x = 0; x < picture.width; ++x) {
            const Rgb c = picture.at(x, y);
            r += c.r * weight, g += c.g * weight, b += c.b * weight;
        }
    }
    return {float(r), float(g), float(b)};
}

/// JSON null where the colour is that of no black body.
Json temperature(Rgb light) {
    const auto kelvin = color_temperature(light);
    return kelvin ? Json(std::round(*kelvin)) : Json();
}

Json report(const Environment& sky, const Image<Rgb>& picture, const SkySettings& settings) {
    Json j;
    const Rgb zenith = sky.radiance({0, 1, 0}), all = horizontal_irradiance(picture), direct = direct_irradiance(sky);
    j["illuminance_total_lux"] = sky.horizontal_illuminance();
    j["illuminance_direct_lux"] = sky.disc_illuminance();
    j["illuminance_sky_lux"] = sky.sky_illuminance();
    j["zenith_luminance_cd_per_m2"] = luminance(zenith);
    j["color_temperature_kelvin"] = {{"total", temperature(all)},
                                     {"direct", temperature(direct)},
                                     {"sky", temperature(all - direct)},
                                     {"zenith", temperature(zenith)}};
    j["sun"] = {{"elevation_degrees", degrees(settings.sun_elevation)},
                {"azimuth_degrees", degrees(settings.sun_azimuth)},
                {"distance_au", settings.sun_distance}};
    if (settings.moon)
        j["moon"] = {{"elevation_degrees", degrees(settings.moon->elevation)},
                     {"azimuth_degrees", degrees(settings.moon->azimuth)},
                     {"lit_share", 0.5 * (1 + std::cos(settings.moon->phase_angle))}};
    j["cloud_cover"] = settings.clouds.cover;
    return j;
}

std::string kelvin_text(const Json& j, const char* light) {
    const Json& value = j["color_temperature_kelvin"][light];
    return value.is_null() ? "no black body's colour" : fmt::format("{:.0f} K", value.get<double>());
}

void print(const Json& j) {
    const auto number = [&](const char* key) { return j[key].get<double>(); };
    std::cout << fmt::format("illuminance     {:.6g} lux, {}\n", number("illuminance_total_lux"),
                             kelvin_text(j, "total"));
    if (number("illuminance_direct_lux") > 0)
        std::cout << fmt::format("  direct        {:.6g} lux, {}\n", number("illuminance_direct_lux"),
                                 kelvin_text(j, "direct"));
    std::cout << fmt::format("  sky           {:.6g} lux, {}\n", number("illuminance_sky_lux"), kelvin_text(j, "sky"));
    std::cout << fmt::format("zenith          {:.6g} cd/m2, {}\n", number("zenith_luminance_cd_per_m2"),
                             kelvin_text(j, "zenith"));
    const auto body = [&](const char* key) {
        return fmt::format("elevation {:.2f}, azimuth {:.2f} degrees", j[key]["elevation_degrees"].get<double>(),
                           j[key]["azimuth_degrees"].get<double>());
    };
    std::cout << "sun             " << body("sun") << "\n";
    if (j.contains("moon"))
        std::cout << "moon            " << body("moon")
                  << fmt::format(", {:.0f} % lit\n", 100 * j["moon"]["lit_share"].get<double>());
}

std::optional<double> exposure(const SkyOptions& o) {
    if (o.exposure == "auto") return std::nullopt;
    double ev = 0;
    if (!parse_number(o.exposure, ev) || !(std::abs(ev) <= 40))
        fail_option("exposure", '"' + o.exposure + '"', "an EV from -40 to 40, or auto");
    return ev;
}

void write_strip(const SkyOptions& o, const std::string& settings) {
    if (o.light.sun_elevation) fail_option("strip", "--sun-elevation beside it", "a place and a date");
    constexpr int columns = 8, rows = 3, size = 116;
    const auto ev = exposure(o);
    const SkyTables tables = cached_sky_tables(atmosphere_settings(o.light));
    SkyStrip strip(columns, rows, size);
    Json hours;
    for (int hour = 0; hour < columns * rows; ++hour) {
        LightOptions light = o.light;
        light.hour = hour;
        const SkySettings at = sky_settings(light, false);
        const Environment sky = make_sky(tables, at);
        const double shown = strip.add(hour, sky, ev, o.view);
        hours.push_back({{"hour", hour},
                         {"sun_elevation_degrees", degrees(at.sun_elevation)},
                         {"illuminance_total_lux", sky.horizontal_illuminance()},
                         {"exposure_ev100", shown}});
        if (!o.json)
            std::cout << fmt::format("{:2d} h  sun {:6.2f} degrees  {:11.5g} lux  EV {:5.2f}\n", hour,
                                     degrees(at.sun_elevation), sky.horizontal_illuminance(), shown);
    }
    strip.write(o.output, settings);
    if (o.json) std::cout << Json{{"hours", hours}}.dump(2) << "\n";
}

void sky_command(const SkyOptions& o) {
    if (o.output.empty() && o.strip) fail_option("strip", "no --output", "a PNG file");
    check_display_view(o.view);
    Json settings;
    add_json(settings, o.light, false);
    settings.erase("lamps");
    if (o.strip) return write_strip(o, settings.dump());
    const SkySettings at = sky_settings(o.light, false);
    const Environment sky = make_environment(o.light, false);
    const Image<Rgb> picture = panorama(sky, 1024, 512);
    if (!o.output.empty()) write_panorama(o.output, picture, settings.dump());
    const Json j = report(sky, picture, at);
    if (o.json)
        std::cout << j.dump(2) << "\n";
    else
        print(j);
}

}  // namespace

void add_sky_command(CLI::App& app) {
    auto* command = app.add_subcommand("sky", "the sky of a time and place: its light in numbers and as a panorama");
    auto options = std::make_shared<SkyOptions>();
    SkyOptions& o = *options;
    add_sky_options(*command, o.light);
    const auto* output = "Output";
    command->add_option("-o,--output", o.output, "EXR file in cd/m2, equirectangular; with --strip a PNG file")
        ->group(output);
    command->add_flag("--strip", o.strip, "the 24 hours of the day in one picture, zenith in the centre, north up")
        ->group(output);
    command->add_option("--exposure", o.exposure, "of the strip: EV at ISO 100, or auto for each hour")
        ->capture_default_str()
        ->group(output);
    command->add_option("--view", o.view, "of the strip: srgb, filmic, aces, raw")
        ->capture_default_str()
        ->group(output);
    command->add_flag("--json", o.json, "print JSON")->group(output);
    for (CLI::Option* option : command->get_options())
        if (option->get_items_expected_max() <= 1) option->take_last();
    command->footer("Example:\n  pluvia sky --hour 18.5 --weather fair -o sky.exr");
    command->callback([options] { sky_command(*options); });
}

}  // namespace pluvia
