// What the options mean: checked and turned into settings of camera, renderer, light and display.
#include "renderer/core/error.h"
#include "renderer/core/units.h"
#include "renderer/image/image_io.h"
#include "tools/render_options.h"

#include <fmt/format.h>

#include <charconv>
#include <iostream>

namespace pluvia {
namespace {

[[noreturn]] void fail(const std::string& option, const std::string& got, const std::string& expected) {
    throw usage_error("--" + option, fmt::format("is not valid (got {}, expected {})", got, expected));
}

void require(bool ok, const std::string& option, double got, const std::string& expected) {
    if (!ok) fail(option, fmt::format("{}", got), expected);
}

Vec3d vector_from(const std::vector<double>& v, const std::string& option) {
    if (v.size() != 3) fail(option, fmt::format("{} numbers", v.size()), "three, X,Y,Z");
    const Vec3d result(v[0], v[1], v[2]);
    require(is_finite(result) && length(result) < 1000, option, length(result), "a speed below 1000 m/s");
    return result;
}

bool parse_number(std::string_view text, auto& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size();
}

/// Angles in radians.
PlaceAndTime place_and_time(const RenderOptions& o) {
    PlaceAndTime at;
    const std::string& d = o.date;
    if (d.size() != 10 || d[4] != '-' || d[7] != '-' || !parse_number(std::string_view(d).substr(0, 4), at.year) ||
        !parse_number(std::string_view(d).substr(5, 2), at.month) ||
        !parse_number(std::string_view(d).substr(8, 2), at.day))
        fail("date", '"' + d + '"', "YYYY-MM-DD");
    require(o.hour >= 0 && o.hour <= 24, "hour", o.hour, "0 to 24");
    require(std::abs(o.latitude) <= 90, "latitude", o.latitude, "-90 to 90");
    require(std::abs(o.longitude) <= 360, "longitude", o.longitude, "-360 to 360");
    require(std::abs(o.utc_offset) <= 14, "utc-offset", o.utc_offset, "-14 to 14");
    at.hour = o.hour;
    at.latitude = radians_from_degrees(o.latitude);
    at.longitude = radians_from_degrees(o.longitude);
    at.utc_offset = o.utc_offset;
    return at;
}

Environment make_sky_environment(const RenderOptions& o) {
    SkySettings sky;
    const std::string weather = !o.weather.empty() ? o.weather : o.rain.empty() ? "clear" : "rain";
    if (o.weather.empty() && !o.rain.empty())
        std::cerr << "pluvia: --rain without --weather: the sky is that of rain\n";
    if (weather == "clear")
        sky.weather = Weather::clear;
    else if (weather == "overcast")
        sky.weather = Weather::overcast;
    else if (weather == "rain")
        sky.weather = Weather::rain;
    else
        fail("weather", '"' + weather + '"', "clear, overcast or rain");
    if (o.sun_azimuth) require(std::abs(*o.sun_azimuth) <= 360, "sun-azimuth", *o.sun_azimuth, "-360 to 360");
    require(o.turbidity >= 2 && o.turbidity <= 10, "turbidity", o.turbidity, "2 to 10");
    sky.turbidity = o.turbidity;
    if (o.sun_elevation) {
        require(std::abs(*o.sun_elevation) <= 90, "sun-elevation", *o.sun_elevation, "-90 to 90");
        sky.sun_elevation = radians_from_degrees(*o.sun_elevation);
        sky.sun_azimuth = radians_from_degrees(o.sun_azimuth.value_or(150));
    } else {
        const SunPosition sun = sun_position(place_and_time(o));
        sky.sun_elevation = sun.elevation;
        sky.sun_azimuth = o.sun_azimuth ? radians_from_degrees(*o.sun_azimuth) : sun.azimuth;
    }
    return make_sky(sky);
}

}  // namespace

CameraSettings camera_settings(const RenderOptions& o) {
    CameraSettings s;
    const size_t x = o.size.find('x');
    if (x == std::string::npos || !parse_number(std::string_view(o.size).substr(0, x), s.width) ||
        !parse_number(std::string_view(o.size).substr(x + 1), s.height) || s.width < 1 || s.height < 1 ||
        s.width > 32768 || s.height > 32768)
        fail("size", '"' + o.size + '"', "WIDTHxHEIGHT, each 1 to 32768");
    if (o.focal_length)
        require(*o.focal_length >= 1 && *o.focal_length <= 10000, "focal-length", *o.focal_length, "1 to 10000 mm");
    if (o.f_number) require(*o.f_number >= 0.5 && *o.f_number <= 1000, "f-number", *o.f_number, "0.5 to 1000");
    if (o.focus && !o.f_number)
        fail("focus", fmt::format("{}", *o.focus), "an --f-number beside it: a pinhole has no focus");
    if (o.focus) require(*o.focus > 0 && *o.focus <= 1e6, "focus", *o.focus, "above 0 m, up to 1000000");
    require(o.shutter >= 1e-6 && o.shutter <= 10, "shutter", o.shutter, "0.000001 to 10 s");
    require(o.fps > 0 && o.fps <= 1e6, "fps", o.fps, "above 0");
    s.focal_length = metres_from_mm(o.focal_length.value_or(0));
    s.f_number = o.f_number.value_or(0);
    s.focus_distance = o.focus.value_or(s.focus_distance);
    s.exposure_time = o.shutter;
    s.mid_exposure = o.frame / o.fps;
    s.velocity = vector_from(o.camera_velocity, "camera-velocity");
    return s;
}

RenderSettings render_settings(const RenderOptions& o) {
    RenderSettings s;
    require(o.spp >= 1 && o.spp <= (1 << 24), "spp", o.spp, "1 to 16777216");
    require(o.bounces >= -1, "bounces", o.bounces, "-1 or more");
    require(o.threads >= 0, "threads", o.threads, "0 or more");
    require(o.depth_max > 0 && o.depth_max <= 1e6, "depth-max", o.depth_max, "above 0 m, up to 1000000");
    s.samples = o.spp;
    s.seed = o.seed;
    if (o.bounces >= 0) s.path.max_bounces = o.bounces;
    for (size_t i = 0; i < o.rain.size(); ++i) {
        require(o.rain[i] >= 0 && o.rain[i] <= 1000, "rain", o.rain[i], "0 to 1000 mm/h");
        for (size_t k = 0; k < i; ++k)
            if (o.rain[k] == o.rain[i]) fail("rain", fmt::format("{} twice", o.rain[i]), "different intensities");
    }
    s.rain.intensities_mm_per_h = o.rain;
    s.rain.wind = vector_from(o.wind, "wind");
    s.rain.seed = o.seed;
    require(o.streak_width >= 0.25 && o.streak_width <= 100, "streak-width", o.streak_width, "0.25 to 100 pixels");
    s.rain.min_width_pixels = o.streak_width;
    if (o.composition == "paper")
        s.streaks.composition = Composition::paper;
    else if (o.composition != "physical")
        fail("composition", '"' + o.composition + '"', "physical or paper");
    require(o.streak_gain > 0 && o.streak_gain <= 1000, "streak-gain", o.streak_gain, "above 0, up to 1000");
    s.streaks.paper_gain = o.streak_gain;
    return s;
}

std::optional<double> exposure_ev100(const RenderOptions& o) {
    if (o.exposure == "auto") return std::nullopt;
    double ev = 0;
    if (!parse_number(o.exposure, ev) || !(std::abs(ev) <= 40))
        fail("exposure", '"' + o.exposure + '"', "an EV from -40 to 40, or auto");
    return ev;
}

Environment make_environment(const RenderOptions& o) {
    if (o.environment.empty()) return make_sky_environment(o);
    require(o.environment_scale >= 0 && std::isfinite(o.environment_scale), "environment-scale", o.environment_scale,
            "0 or more");
    float rgb[3];
    const std::string& text = o.environment;
    const size_t a = text.find(','), b = a == std::string::npos ? a : text.find(',', a + 1);
    Environment environment;
    if (b != std::string::npos && parse_number(std::string_view(text).substr(0, a), rgb[0]) &&
        parse_number(std::string_view(text).substr(a + 1, b - a - 1), rgb[1]) &&
        parse_number(std::string_view(text).substr(b + 1), rgb[2])) {
        for (const float c : rgb) require(c >= 0 && std::isfinite(c), "environment", c, "R,G,B of 0 or more");
        environment = Environment::uniform({rgb[0], rgb[1], rgb[2]});
    } else {
        environment = Environment(read_radiance(text));
    }
    double scale = o.environment_scale;
    if (o.environment_illuminance) {
        require(*o.environment_illuminance >= 0 && std::isfinite(*o.environment_illuminance), "environment-illuminance",
                *o.environment_illuminance, "0 lux or more");
        if (environment.horizontal_illuminance() <= 0)
            throw input_error(text, "gives no light from above, so it cannot be scaled to an illuminance");
        scale = *o.environment_illuminance / environment.horizontal_illuminance();
    }
    environment.multiply(float(scale));
    return environment;
}

}  // namespace pluvia
