// What the options mean: checked and turned into settings of camera, renderer and display.
#include "renderer/core/units.h"
#include "renderer/image/exposure.h"
#include "tools/option_check.h"
#include "tools/render_options.h"

#include <fmt/format.h>

namespace pluvia {
namespace {

Vec3d vector_from(const std::vector<double>& v, const std::string& option) {
    if (v.size() != 3) fail_option(option, fmt::format("{} numbers", v.size()), "three, X,Y,Z");
    const Vec3d result(v[0], v[1], v[2]);
    require_option(is_finite(result) && length(result) < 1000, option, length(result), "a speed below 1000 m/s");
    return result;
}

}  // namespace

CameraSettings camera_settings(const RenderOptions& o) {
    CameraSettings s;
    const size_t x = o.size.find('x');
    if (x == std::string::npos || !parse_number(std::string_view(o.size).substr(0, x), s.width) ||
        !parse_number(std::string_view(o.size).substr(x + 1), s.height) || s.width < 1 || s.height < 1 ||
        s.width > 32768 || s.height > 32768)
        fail_option("size", '"' + o.size + '"', "WIDTHxHEIGHT, each 1 to 32768");
    if (o.focal_length)
        require_option(*o.focal_length >= 1 && *o.focal_length <= 10000, "focal-length", *o.focal_length,
                       "1 to 10000 mm");
    if (o.f_number) require_option(*o.f_number >= 0.5 && *o.f_number <= 1000, "f-number", *o.f_number, "0.5 to 1000");
    if (o.focus && !o.f_number)
        fail_option("focus", fmt::format("{}", *o.focus), "an --f-number beside it: a pinhole has no focus");
    if (o.focus) require_option(*o.focus > 0 && *o.focus <= 1e6, "focus", *o.focus, "above 0 m, up to 1000000");
    require_option(o.shutter >= 1e-6 && o.shutter <= 10, "shutter", o.shutter, "0.000001 to 10 s");
    require_option(o.fps > 0 && o.fps <= 1e6, "fps", o.fps, "above 0");
    s.focal_length = metres_from_mm(o.focal_length.value_or(0));
    s.f_number = o.f_number.value_or(0);
    s.focus_distance = o.focus.value_or(s.focus_distance);
    s.exposure_time = o.shutter;
    s.mid_exposure = o.frame / o.fps;
    if (!o.camera_velocity.empty()) s.velocity = vector_from(o.camera_velocity, "camera-velocity");
    return s;
}

RenderSettings render_settings(const RenderOptions& o) {
    RenderSettings s;
    require_option(o.spp >= 1 && o.spp <= (1 << 24), "spp", o.spp, "1 to 16777216");
    require_option(o.bounces >= -1, "bounces", o.bounces, "-1 or more");
    if (o.texture_size) require_option(*o.texture_size >= 1, "texture-size", *o.texture_size, "1 or more");
    require_option(o.threads >= 0, "threads", o.threads, "0 or more");
    require_option(o.depth_max > 0 && o.depth_max <= 1e6, "depth-max", o.depth_max, "above 0 m, up to 1000000");
    if (o.target_error)
        require_option(*o.target_error >= 1e-4 && *o.target_error <= 10, "target-error", *o.target_error,
                       "0.0001 to 10");
    s.samples = o.spp;
    s.seed = o.seed;
    if (o.bounces >= 0) s.path.max_bounces = o.bounces;
    for (size_t i = 0; i < o.rain.size(); ++i) {
        require_option(o.rain[i] >= 0 && o.rain[i] <= 1000, "rain", o.rain[i], "0 to 1000 mm/h");
        for (size_t k = 0; k < i; ++k)
            if (o.rain[k] == o.rain[i])
                fail_option("rain", fmt::format("{} twice", o.rain[i]), "different intensities");
    }
    s.rain.intensities_mm_per_h = o.rain;
    s.rain.wind = vector_from(o.wind, "wind");
    s.rain.seed = o.rain_seed.value_or(o.seed);
    if (!o.wet_wind.empty()) s.wet_wind = vector_from(o.wet_wind, "wet-wind");
    if (!o.wind_travel.empty()) {
        if (o.wind_travel.size() != 3)
            fail_option("wind-travel", fmt::format("{} numbers", o.wind_travel.size()), "three, X,Y,Z");
        const Vec3d travel(o.wind_travel[0], o.wind_travel[1], o.wind_travel[2]);
        require_option(is_finite(travel) && length(travel) <= 1e7, "wind-travel", length(travel), "up to 10000 km");
        s.rain.wind_travel = travel;
    }
    if (o.composition == "paper")
        s.streaks.composition = Composition::paper;
    else if (o.composition != "physical")
        fail_option("composition", '"' + o.composition + '"', "physical or paper");
    s.rain.min_width_pixels = streak_width(o);
    require_option(s.rain.min_width_pixels >= 0.25 && s.rain.min_width_pixels <= 100, "streak-width",
                   s.rain.min_width_pixels, "0.25 to 100 pixels");
    require_option(o.fog_beta >= 0 && o.fog_beta <= 1, "fog-beta", o.fog_beta, "0 to 1 per metre");
    s.rain.fog_extinction = o.fog_beta;
    if (o.veil != "traced" && o.veil != "table") fail_option("veil", '"' + o.veil + '"', "traced or table");
    s.streaks.tabled_veil = o.veil == "table";
    require_option(o.streak_gain > 0 && o.streak_gain <= 1000, "streak-gain", o.streak_gain, "above 0, up to 1000");
    s.streaks.paper_gain = o.streak_gain;
    require_option(o.wetness >= 0 && o.wetness <= 1, "wetness", o.wetness, "0 to 1");
    require_option(o.puddles >= 0 && o.puddles <= 1, "puddles", o.puddles, "0 to 1");
    require_option(o.ripples >= 0 && o.ripples <= 1000, "ripples", o.ripples, "0 to 1000 mm/h");
    if (o.ripples > 0 && o.puddles == 0)
        fail_option("ripples", fmt::format("{}", o.ripples), "--puddles above 0 beside it: rings need standing water");
    s.wet = {float(o.wetness), float(o.puddles), o.ripples};
    require_option(o.streak_distance >= 0 && o.streak_distance <= 100, "streak-distance", o.streak_distance,
                   "0 to 100 m");
    require_option(o.streak_share > 0 && o.streak_share <= 1, "streak-share", o.streak_share, "above 0, up to 1");
    s.rain.painted_distance = o.streak_distance;
    s.rain.share = o.streak_share;
    const bool paper = o.composition == "paper";
    if (!paper && o.streak_distance > 0)
        fail_option("streak-distance", "physical rain", "--composition paper beside it");
    if (!paper && o.streak_share < 1) fail_option("streak-share", "physical rain", "--composition paper beside it");
    if (!paper && !o.streaks.empty()) fail_option("streaks", "physical rain", "--composition paper beside it");
    return s;
}

std::optional<double> exposure_ev100(const RenderOptions& o) {
    if (o.exposure == "auto") return std::nullopt;
    double ev = 0;
    if (!parse_number(o.exposure, ev) || !(std::abs(ev) <= 40))
        fail_option("exposure", '"' + o.exposure + '"', "an EV from -40 to 40, or auto");
    return ev;
}

float unlit_luminance(const std::optional<double>& ev100, const Environment& environment) {
    if (ev100) return 1 / exposure_scale(*ev100);
    const double paper = environment.horizontal_illuminance() / pi;
    return paper > 0 ? float(paper) : 100.0f;
}

}  // namespace pluvia
