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
        {"streak-width",
         "--streak-width; biased: narrower drops are light spread over the picture, which is right in the mean, and no "
         "streaks"},
        {"streak-roulette",
         "share of the picture's light below which the light of a streak is computed at random (0.1; no option)"},
        {"medium-roulette", "the same for the light of fine rain (0.2; no option)"},
        {"composition", "--composition; not an error: the paper's rain is another picture"},
    };
    return dials;
}

const char* fixed_dials() {
    return "Without a dial, since nobody has needed another place: light samples of a path's vertex (8 chosen by the\n"
           "light tree, of which one is tested for visibility), where roulette sets in (the third vertex, by what the\n"
           "path still carries), points of the medium on a camera ray (up to 4), the sky (512 x 512 texels, tables of\n"
           "the atmosphere as published), textures (as the file has them).\n";
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
    for (const double error : {0.4, 0.2, 0.1})
        settings.push_back(
            {"target-error", fmt::format("{}", error), false, [error](RenderOptions& o) { o.target_error = error; }});
    for (const int n : {1, 2, 4, 8})
        settings.push_back({"bounces", std::to_string(n), true, [n](RenderOptions& o) { o.bounces = n; }});
    if (!rains) return settings;
    for (const double width : {0.5, 1.0, 2.0})
        settings.push_back(
            {"streak-width", fmt::format("{}", width), true, [width](RenderOptions& o) { o.streak_width = width; }});
    if (!physical) return settings;
    for (const double c : {0.02, 1.0})
        settings.push_back({"streak-roulette", fmt::format("{}", c), false, {}, [c](RenderSettings& s) {
                                s.streaks.streak_roulette = c;
                            }});
    for (const double c : {0.05, 1.0})
        settings.push_back({"medium-roulette", fmt::format("{}", c), false, {}, [c](RenderSettings& s) {
                                s.streaks.medium_roulette = c;
                            }});
    settings.push_back({"composition", "paper", true, [](RenderOptions& o) { o.composition = "paper"; }});
    return settings;
}

}  // namespace pluvia
