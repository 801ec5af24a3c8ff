#include "tools/light_options.h"

#include "renderer/core/units.h"
#include "renderer/image/image_io.h"
#include "shaders/night.h"
#include "tools/option_check.h"
#include "tools/sky_cache.h"

#include <cmath>
#include <iostream>

namespace pluvia {
namespace {

constexpr double lamp_illuminance = 50;  // lux of the environment below which lamps are on
const char* const group = "Light";

/// Angles in radians.
PlaceAndTime place_and_time(const LightOptions& o) {
    PlaceAndTime at;
    const std::string& d = o.date;
    if (d.size() != 10 || d[4] != '-' || d[7] != '-' || !parse_number(std::string_view(d).substr(0, 4), at.year) ||
        !parse_number(std::string_view(d).substr(5, 2), at.month) ||
        !parse_number(std::string_view(d).substr(8, 2), at.day))
        fail_option("date", '"' + d + '"', "YYYY-MM-DD");
    require_option(o.hour >= 0 && o.hour <= 24, "hour", o.hour, "0 to 24");
    require_option(std::abs(o.latitude) <= 90, "latitude", o.latitude, "-90 to 90");
    require_option(std::abs(o.longitude) <= 360, "longitude", o.longitude, "-360 to 360");
    require_option(std::abs(o.utc_offset) <= 14, "utc-offset", o.utc_offset, "-14 to 14");
    at.hour = o.hour;
    at.latitude = radians_from_degrees(o.latitude);
    at.longitude = radians_from_degrees(o.longitude);
    at.utc_offset = o.utc_offset;
    return at;
}

std::string weather_name(const LightOptions& o, bool rains) {
    return !o.weather.empty() ? o.weather : rains ? "rain" : "clear";
}

/// The entry of a table with a name; "A, B or C" is expected.
template <class Table>
const auto& entry(const Table& table, const std::string& name, const std::string& option) {
    std::string expected;
    for (size_t i = 0; i < table.size(); ++i) {
        if (name == table[i].name) return table[i];
        expected += (i == 0 ? "" : i + 1 == table.size() ? " or " : ", ") + std::string(table[i].name);
    }
    fail_option(option, '"' + name + '"', expected);
}

double city_glow(const std::string& text) {
    double glow = 0;
    if (!parse_number(text, glow)) return entry(city_glows, text, "city-glow").luminance;
    require_option(glow >= 0 && glow <= 100, "city-glow", glow, "0 to 100 cd/m2");
    return glow;
}

const WeatherPreset& weather(const LightOptions& o, bool rains) {
    return entry(weather_presets, weather_name(o, rains), "weather");
}
double cloud_cover(const LightOptions& o, bool rains) {
    return o.cloud_cover.value_or(weather(o, rains).cover);
}
std::string cloud_type(const LightOptions& o, bool rains) {
    return o.cloud_type.empty() ? weather(o, rains).cloud_type : o.cloud_type;
}

/// Empty when the text is not three numbers between commas.
std::optional<Rgb> parse_rgb(const std::string& text) {
    const size_t a = text.find(','), b = a == std::string::npos ? a : text.find(',', a + 1);
    Rgb c;
    if (b == std::string::npos || !parse_number(std::string_view(text).substr(0, a), c.r) ||
        !parse_number(std::string_view(text).substr(a + 1, b - a - 1), c.g) ||
        !parse_number(std::string_view(text).substr(b + 1), c.b))
        return std::nullopt;
    for (const float v : {c.r, c.g, c.b})
        require_option(v >= 0 && std::isfinite(v), "environment", v, "R,G,B of 0 or more");
    return c;
}

}  // namespace

void add_sky_options(CLI::App& command, LightOptions& o) {
    const auto add = [&](const char* name, auto& value, const char* text) {
        return command.add_option(name, value, text)->group(group);
    };
    add("--hour", o.hour, "local time, 0 to 24")->capture_default_str();
    add("--date", o.date, "YYYY-MM-DD")->capture_default_str();
    add("--latitude", o.latitude, "degrees, north positive")->capture_default_str();
    add("--longitude", o.longitude, "degrees, east positive")->capture_default_str();
    add("--utc-offset", o.utc_offset, "hours that local time is ahead of UTC")->capture_default_str();
    add("--sun-elevation", o.sun_elevation, "degrees, instead of time and place, and without a moon");
    add("--sun-azimuth", o.sun_azimuth, "degrees clockwise from north (-Z), with --sun-elevation");
    add("--weather", o.weather,
        "clear, fair, cloudy, overcast, drizzle, rain, heavy-rain or thunderstorm; default: rain with --rain, else "
        "clear");
    add("--cloud-cover", o.cloud_cover, "0 to 1, instead of the weather's");
    add("--cloud-type", o.cloud_type,
        "instead of the weather's: cirrus, altocumulus, cumulus, stratus, nimbostratus, heavy-rain or thunderstorm");
    add("--city-glow", o.city_glow, "light of a town on the clouds: none, village, suburb, city, or cd/m2")
        ->capture_default_str();
    add("--turbidity", o.turbidity, "haze of the clear sky, 1 to 10")->capture_default_str();
}

void add_light_options(CLI::App& command, LightOptions& o) {
    add_sky_options(command, o);
    command
        .add_option("--environment", o.environment,
                    "instead of the sky: equirectangular HDR or EXR file, or R,G,B in cd/m2")
        ->group(group);
    command.add_option("--environment-scale", o.environment_scale, "cd/m2 per unit of the file")
        ->capture_default_str()
        ->group(group);
    command
        .add_option("--environment-illuminance", o.environment_illuminance,
                    "scale the file to this horizontal illuminance in lux")
        ->group(group);
    command
        .add_option("--lamps", o.lamps, "what the scene marks as lamps: on, off, or auto: on below 50 lux of daylight")
        ->capture_default_str()
        ->group(group);
}

AtmosphereSettings atmosphere_settings(const LightOptions& o) {
    require_option(o.turbidity >= 1 && o.turbidity <= 10, "turbidity", o.turbidity, "1 to 10");
    AtmosphereSettings settings;
    if (o.turbidity != LightOptions().turbidity) settings.beta = beta_from_turbidity(o.turbidity);
    return settings;
}

SkySettings sky_settings(const LightOptions& o, bool rains) {
    SkySettings sky;
    sky.clouds.cover = cloud_cover(o, rains);
    require_option(sky.clouds.cover >= 0 && sky.clouds.cover <= 1, "cloud-cover", sky.clouds.cover, "0 to 1");
    sky.clouds.transmittance = entry(cloud_types, cloud_type(o, rains), "cloud-type").transmittance;
    sky.city_glow = city_glow(o.city_glow);
    sky.texels = o.sky_texels;
    if (o.sun_azimuth) require_option(std::abs(*o.sun_azimuth) <= 360, "sun-azimuth", *o.sun_azimuth, "-360 to 360");
    if (o.sun_elevation) {
        require_option(std::abs(*o.sun_elevation) <= 90, "sun-elevation", *o.sun_elevation, "-90 to 90");
        sky.sun_elevation = radians_from_degrees(*o.sun_elevation);
        sky.sun_azimuth = radians_from_degrees(o.sun_azimuth.value_or(150));
        return sky;
    }
    const PlaceAndTime at = place_and_time(o);
    const SunPosition sun = sun_position(at);
    sky.sun_elevation = sun.elevation + refraction(sun.elevation);
    sky.sun_azimuth = o.sun_azimuth ? radians_from_degrees(*o.sun_azimuth) : sun.azimuth;
    sky.sun_distance = sun.distance;
    const MoonPosition moon = moon_position(at);
    sky.moon = Moon{moon.elevation + refraction(moon.elevation), moon.azimuth, moon.parallax, moon.phase_angle};
    return sky;
}

Environment make_environment(const LightOptions& o, bool rains) {
    if (o.lamps != "on" && o.lamps != "off" && o.lamps != "auto")
        fail_option("lamps", '"' + o.lamps + '"', "on, off or auto");
    if (o.environment.empty()) {
        const SkySettings settings = sky_settings(o, rains);
        const AtmosphereSettings atmosphere = atmosphere_settings(o);
        if (o.weather.empty() && rains) std::cerr << "pluvia: --rain without --weather: the sky is that of rain\n";
        return make_sky(cached_sky_tables(atmosphere), settings);
    }
    require_option(o.environment_scale >= 0 && std::isfinite(o.environment_scale), "environment-scale",
                   o.environment_scale, "0 or more");
    const auto rgb = parse_rgb(o.environment);
    Environment environment = rgb ? Environment::uniform(*rgb) : Environment(read_radiance(o.environment));
    double scale = o.environment_scale;
    if (o.environment_illuminance) {
        require_option(*o.environment_illuminance >= 0 && std::isfinite(*o.environment_illuminance),
                       "environment-illuminance", *o.environment_illuminance, "0 lux or more");
        if (environment.horizontal_illuminance() <= 0)
            throw input_error(o.environment, "gives no light from above, so it cannot be scaled to an illuminance");
        scale = *o.environment_illuminance / environment.horizontal_illuminance();
    }
    environment.multiply(float(scale));
    return environment;
}

bool lamps_are_on(const LightOptions& o, const Environment& environment) {
    return o.lamps == "on" || (o.lamps == "auto" && environment.horizontal_illuminance() < lamp_illuminance);
}

void add_json(nlohmann::ordered_json& j, const LightOptions& o, bool rains) {
    if (o.environment.empty()) {
        j["hour"] = o.hour, j["date"] = o.date, j["latitude"] = o.latitude, j["longitude"] = o.longitude;
        j["utc-offset"] = o.utc_offset;
        if (o.sun_elevation) j["sun-elevation"] = *o.sun_elevation;
        if (o.sun_azimuth) j["sun-azimuth"] = *o.sun_azimuth;
        j["weather"] = weather_name(o, rains);
        j["cloud-cover"] = cloud_cover(o, rains), j["cloud-type"] = cloud_type(o, rains);
        j["city-glow"] = o.city_glow, j["turbidity"] = o.turbidity;
    } else {
        // The file's name without its folder: a picture does not change with the place where its light is kept.
        j["environment"] = o.environment.substr(o.environment.find_last_of('/') + 1);
        j["environment-scale"] = o.environment_scale;
        if (o.environment_illuminance) j["environment-illuminance"] = *o.environment_illuminance;
    }
    j["lamps"] = o.lamps;
}

}  // namespace pluvia
