#include "tools/render_options.h"

#include "renderer/core/error.h"
#include "renderer/core/units.h"
#include "renderer/image/color.h"
#include "renderer/image/image_io.h"

#include <fmt/format.h>

#include <charconv>
#include <iostream>

namespace pluvia {

void add_render_options(CLI::App& command, RenderOptions& o) {
    // Of scalar options given twice the last counts, so that scripts can append to a command.
    command.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    command.add_option("scene", o.scene, "glTF file, .glb or .gltf")->required();
    command.add_option("-o,--output", o.output, "folder for frame.exr, pictures and frame.json")->required();

    const auto* camera = "Camera";
    command.add_option("--camera", o.camera, "name or number; default: the first, or one that shows the whole scene")->group(camera);
    command.add_option("--size", o.size, "WIDTHxHEIGHT in pixels; the vertical field of view stays")->capture_default_str()->group(camera);
    command.add_option("--frame", o.frame, "number of the frame, at frame / fps seconds")->capture_default_str()->group(camera);
    command.add_option("--fps", o.fps, "frames per second")->capture_default_str()->group(camera);
    command.add_option("--focal-length", o.focal_length, "mm on a sensor 36 mm wide; default: the camera's own field of view")->group(camera);
    command.add_option("--f-number", o.f_number, "lens opening; default: pinhole")->group(camera);
    command.add_option("--focus", o.focus, "metres in focus [10]; needs --f-number")->group(camera);
    command.add_option("--shutter", o.shutter, "exposure time in seconds, which makes the streaks")->capture_default_str()->group(camera);
    command.add_option("--camera-velocity", o.camera_velocity, "X,Y,Z in m/s; slants the streaks")->delimiter(',')->expected(3)->multi_option_policy(CLI::MultiOptionPolicy::Throw)->group(camera);

    const auto* quality = "Accuracy";
    command.add_option("--spp", o.spp, "samples per pixel")->capture_default_str()->group(quality);
    command.add_option("--bounces", o.bounces, "cut paths after this many; BIASED: loses light. -1 = unlimited, unbiased")->capture_default_str()->group(quality);
    command.add_option("--seed", o.seed, "of all random numbers")->capture_default_str()->group(quality);

    const auto* rain = "Rain (seen directly; what mirrors and glass show is dry)";
    command.add_option("--rain", o.rain, "intensities in mm/h, e.g. 10,25,50,100; 0 to 1000 (drop sizes are a fit up to about 500)")->delimiter(',')->multi_option_policy(CLI::MultiOptionPolicy::Throw)->group(rain);
    command.add_option("--wind", o.wind, "X,Y,Z in m/s")->delimiter(',')->expected(3)->multi_option_policy(CLI::MultiOptionPolicy::Throw)->group(rain);
    command.add_option("--composition", o.composition, "physical, or paper: the formula of 'Learning from Rendering'")->capture_default_str()->group(rain);
    command.add_option("--streak-gain", o.streak_gain, "paper: factor on the light of streaks; 1 = exact, 24.5 = the published code")->capture_default_str()->group(rain);
    command.add_option("--streak-width", o.streak_width, "pixels; drops narrower than this are left out; BIASED: less water is seen")->capture_default_str()->group(rain);

    const auto* light = "Light";
    command.add_option("--hour", o.hour, "local time, 0 to 24")->capture_default_str()->group(light);
    command.add_option("--date", o.date, "YYYY-MM-DD")->capture_default_str()->group(light);
    command.add_option("--latitude", o.latitude, "degrees, north positive")->capture_default_str()->group(light);
    command.add_option("--longitude", o.longitude, "degrees, east positive")->capture_default_str()->group(light);
    command.add_option("--utc-offset", o.utc_offset, "hours that local time is ahead of UTC")->capture_default_str()->group(light);
    command.add_option("--sun-elevation", o.sun_elevation, "degrees, instead of time and place")->group(light);
    command.add_option("--sun-azimuth", o.sun_azimuth, "degrees clockwise from north (-Z), with --sun-elevation")->group(light);
    command.add_option("--weather", o.weather, "clear, overcast or rain; default: rain with --rain, else clear")->group(light);
    command.add_option("--turbidity", o.turbidity, "haze of the clear sky, 2 to 10")->capture_default_str()->group(light);
    command.add_option("--environment", o.environment, "instead of the sky: equirectangular HDR or EXR file, or R,G,B in cd/m2")->group(light);
    command.add_option("--environment-scale", o.environment_scale, "cd/m2 per unit of the file")->capture_default_str()->group(light);
    command.add_option("--environment-illuminance", o.environment_illuminance, "scale the file to this horizontal illuminance in lux")->group(light);

    const auto* output = "Output";
    command.add_option("--exposure", o.exposure, "EV at ISO 100, or auto")->capture_default_str()->group(output);
    command.add_option("--view", o.view, "display transform of the PNGs: srgb, filmic, aces, raw")->capture_default_str()->group(output);
    command.add_option("--depth-encoding", o.depth_encoding, "of depth.png: kitti16, mm16, carla24, hri")->capture_default_str()->group(output);
    command.add_option("--depth-max", o.depth_max, "metres of a full value in the encoding hri")->capture_default_str()->group(output);
    command.add_flag("--overwrite", o.overwrite, "replace a finished frame in the folder")->group(output);
    command.add_option("--threads", o.threads, "0 = all; changes no byte")->capture_default_str()->group(output);
    command.add_option("--progress", o.progress, "bar, json or none, on stderr")->capture_default_str()->group(output);
    command.add_flag("--json", o.json, "print what was done as JSON on stdout")->group(output);
    for (CLI::Option* option : command.get_options()) {
        // A script may append options to a command line: of values given twice the last one wins.
        if (option->get_items_expected_max() <= 1) option->take_last();
        // Lists are written with commas, so that a list before the scene's name does not swallow it.
        else option->allow_extra_args(false);
    }
    command.footer("Example:\n  pluvia render lane.glb --camera front --rain 10,50 --hour 20 -o out/lane");
}

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

/// Day of the year of YYYY-MM-DD.
PlaceAndTime place_and_time(const RenderOptions& o) {
    PlaceAndTime at;
    const std::string& d = o.date;
    if (d.size() != 10 || d[4] != '-' || d[7] != '-' || !parse_number(std::string_view(d).substr(0, 4), at.year) ||
        !parse_number(std::string_view(d).substr(5, 2), at.month) || !parse_number(std::string_view(d).substr(8, 2), at.day))
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
    if (o.weather.empty() && !o.rain.empty()) std::cerr << "pluvia: --rain without --weather: the sky is that of rain\n";
    if (weather == "clear") sky.weather = Weather::clear;
    else if (weather == "overcast") sky.weather = Weather::overcast;
    else if (weather == "rain") sky.weather = Weather::rain;
    else fail("weather", '"' + weather + '"', "clear, overcast or rain");
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
    if (o.focal_length) require(*o.focal_length >= 1 && *o.focal_length <= 10000, "focal-length", *o.focal_length, "1 to 10000 mm");
    if (o.f_number) require(*o.f_number >= 0.5 && *o.f_number <= 1000, "f-number", *o.f_number, "0.5 to 1000");
    if (o.focus && !o.f_number) fail("focus", fmt::format("{}", *o.focus), "an --f-number beside it: a pinhole has no focus");
    if (o.focus) require(*o.focus > 0, "focus", *o.focus, "above 0 m");
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
    if (o.composition == "paper") s.streaks.composition = Composition::paper;
    else if (o.composition != "physical") fail("composition", '"' + o.composition + '"', "physical or paper");
    require(o.streak_gain > 0 && o.streak_gain <= 1000, "streak-gain", o.streak_gain, "above 0, up to 1000");
    s.streaks.paper_gain = o.streak_gain;
    return s;
}

std::optional<double> exposure_ev100(const RenderOptions& o) {
    if (o.exposure == "auto") return std::nullopt;
    double ev = 0;
    if (!parse_number(o.exposure, ev) || !(std::abs(ev) <= 40)) fail("exposure", '"' + o.exposure + '"', "an EV from -40 to 40, or auto");
    return ev;
}

Environment make_environment(const RenderOptions& o) {
    if (o.environment.empty()) return make_sky_environment(o);
    require(o.environment_scale >= 0 && std::isfinite(o.environment_scale), "environment-scale", o.environment_scale, "0 or more");
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
        require(*o.environment_illuminance >= 0, "environment-illuminance", *o.environment_illuminance, "0 lux or more");
        if (environment.horizontal_illuminance() <= 0)
            throw input_error(text, "gives no light from above, so it cannot be scaled to an illuminance");
        scale = *o.environment_illuminance / environment.horizontal_illuminance();
    }
    environment.multiply(float(scale));
    return environment;
}

nlohmann::ordered_json to_json(const RenderOptions& o) {
    nlohmann::ordered_json j;
    const auto optional = [&](const char* key, const std::optional<double>& value) {
        if (value) j[key] = *value;
    };
    j["camera"] = o.camera, j["size"] = o.size, j["frame"] = o.frame, j["fps"] = o.fps;
    optional("focal-length", o.focal_length), optional("f-number", o.f_number), optional("focus", o.focus);
    j["shutter"] = o.shutter, j["camera-velocity"] = o.camera_velocity;
    j["spp"] = o.spp, j["bounces"] = o.bounces, j["seed"] = o.seed;
    j["rain"] = o.rain, j["wind"] = o.wind, j["composition"] = o.composition;
    j["streak-gain"] = o.streak_gain, j["streak-width"] = o.streak_width;
    if (o.environment.empty()) {
        j["hour"] = o.hour, j["date"] = o.date, j["latitude"] = o.latitude, j["longitude"] = o.longitude;
        j["utc-offset"] = o.utc_offset;
        optional("sun-elevation", o.sun_elevation), optional("sun-azimuth", o.sun_azimuth);
        j["weather"] = !o.weather.empty() ? o.weather : o.rain.empty() ? "clear" : "rain";
        j["turbidity"] = o.turbidity;
    } else {
        // The file's name without its folder: a picture does not change with the place where its light is kept.
        j["environment"] = o.environment.substr(o.environment.find_last_of('/') + 1);
        j["environment-scale"] = o.environment_scale;
        optional("environment-illuminance", o.environment_illuminance);
    }
    j["exposure"] = o.exposure, j["view"] = o.view;
    j["depth-encoding"] = o.depth_encoding, j["depth-max"] = o.depth_max;
    return j;
}

}  // namespace pluvia
