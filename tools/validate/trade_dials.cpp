#include "tools/validate/trade_dials.h"

#include "renderer/core/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace pluvia {

const std::vector<TradeDial>& trade_dials() {
    static const std::vector<TradeDial> dials = {
        {"samples", "--spp; 16, 64, 256 and 1024 are --quality draft, standard, high and reference"},
        {"target-error", "--target-error, its pilot included"},
        {"bounces", "--bounces; biased: loses light"},
        {"path-roulette", "share of the light it meets below which a path is ended at random (0.25; no option)"},
        {"shadow-roulette",
         "share of the picture's light below which a shadow ray is traced at random (0.25; no option)"},
        {"light-samples", "samples of lamps that compete for a path's first shadow ray (8; no option)"},
        {"sky-texels", "of the sky's picture, in each direction (512; no option)"},
        {"texture-size", "--texture-size; biased: blurs"},
        {"streak-width",
         "--streak-width; biased: narrower drops are light spread over the picture, which is right in the mean, and no "
         "streaks"},
        {"streak-roulette",
         "share of the picture's light below which the light of a streak is computed at random (0.25; no option)"},
        {"medium-roulette",
         "the same for the light of fine rain, which is how many of its points are lit (0.25; no option)"},
        {"veil", "--veil; biased: light of fine rain is interpolated"},
        {"composition", "--composition; not an error: the paper's rain is another picture"},
    };
    return dials;
}

void check_dials(const std::vector<std::string>& names) {
    std::vector<std::string> known;
    for (const TradeDial& dial : trade_dials()) known.emplace_back(dial.name);
    for (const std::string& name : names)
        if (std::find(known.begin(), known.end(), name) == known.end())
            throw usage_error("--only", fmt::format("does not know this dial (got \"{}\", expected {})", name,
                                                    fmt::join(known, ", ")));
}

std::vector<TradeSetting> trade_settings(bool rains, bool physical) {
    std::vector<TradeSetting> settings;
    for (const int n : {1, 4, 16, 64, 256})
        settings.push_back({"samples", std::to_string(n), false, [n](RenderOptions& o) { o.spp = n; }});
    for (const double error : {0.8, 0.4, 0.2})
        settings.push_back(
            {"target-error", fmt::format("{}", error), false, [error](RenderOptions& o) { o.target_error = error; }});
    for (const int n : {1, 2, 4, 8})
        settings.push_back({"bounces", std::to_string(n), true, [n](RenderOptions& o) { o.bounces = n; }});
    const auto add_code = [&](const char* dial, auto value, auto set) {
        settings.push_back({dial, fmt::format("{}", value), false, {}, [=](RenderSettings& s) { set(s, value); }});
    };
    for (const double c : {0.05, 1.0})
        add_code("path-roulette", c, [](auto& s, double v) { s.path.path_roulette = float(v); });
    for (const double c : {0.0, 1.0})
        add_code("shadow-roulette", c, [](auto& s, double v) { s.path.shadow_roulette = float(v); });
    for (const int n : {1, 2, 4, 16}) add_code("light-samples", n, [](auto& s, int v) { s.path.light_samples = v; });
    for (const int n : {128, 256, 1024})
        settings.push_back(
            {"sky-texels", std::to_string(n), true, [n](RenderOptions& o) { o.light.sky_texels = n; }, {}, true});
    for (const int n : {64, 256})
        settings.push_back(
            {"texture-size", std::to_string(n), true, [n](RenderOptions& o) { o.texture_size = n; }, {}, true});
    if (!rains) return settings;
    for (const double width : {0.5, 1.0, 2.0})
        settings.push_back(
            {"streak-width", fmt::format("{}", width), true, [width](RenderOptions& o) { o.streak_width = width; }});
    if (!physical) return settings;
    for (const double c : {0.02, 1.0})
        add_code("streak-roulette", c, [](auto& s, double v) { s.streaks.streak_roulette = v; });
    for (const double c : {0.05, 1.0})
        add_code("medium-roulette", c, [](auto& s, double v) { s.streaks.medium_roulette = v; });
    settings.push_back({"veil", "table", true, [](RenderOptions& o) { o.veil = "table"; }});
    settings.push_back({"composition", "paper", true, [](RenderOptions& o) { o.composition = "paper"; }});
    return settings;
}

}  // namespace pluvia
