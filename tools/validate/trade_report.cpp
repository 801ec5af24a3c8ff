#include "tools/validate/trade_report.h"

#include <fmt/format.h>

namespace pluvia {
namespace {

nlohmann::ordered_json layer_json(const LayerError& e) {
    return {
        {"error", e.error}, {"flip", e.flip}, {"bias", e.bias}, {"bias_low", e.bias_low}, {"bias_high", e.bias_high}};
}

LayerError layer_from(const nlohmann::ordered_json& j) {
    return {j.at("error"), j.at("flip"), j.at("bias"), j.at("bias_low"), j.at("bias_high")};
}

}  // namespace

std::string trade_table(const TradeReport& report) {
    std::string text = fmt::format(
        "{}; reference: {} samples, its own error {:.4f}\n\n{:>15} {:>9} {:>7} {:>9} {:>9}  {:>7} {:>7}  {:>7} {:>7}  "
        "{:>16} {:>16}\n",
        report.scene, report.reference_samples, report.reference_error, "dial", "value", "samples", "cpu s", "wall s",
        "error", "rainy", "FLIP", "rainy", "bias %", "rainy");
    const std::vector<bool> front = pareto_front(report.results);
    const auto bias = [](const LayerError& e) {
        return fmt::format("{:+.2f} +-{:.2f}", 100 * e.bias, 50 * (e.bias_high - e.bias_low));
    };
    for (size_t i = 0; i < report.results.size(); ++i) {
        const TradeResult& r = report.results[i];
        const auto rainy = [&](double LayerError::*value) {
            return r.rainy ? fmt::format("{:.4f}", (*r.rainy).*value) : std::string("-");
        };
        text +=
            fmt::format("{:>15} {:>9} {:>7} {:>9.2f} {:>9.2f}  {:>7.4f} {:>7}  {:>7.4f} {:>7}  {:>16} {:>16} {}\n",
                        r.dial, r.value, r.samples, r.cpu_s, r.wall_s, r.background.error, rainy(&LayerError::error),
                        r.background.flip, rainy(&LayerError::flip), bias(r.background), r.rainy ? bias(*r.rainy) : "-",
                        front[i]   ? "*"
                        : r.biased ? "b"
                                   : "");
    }
    return text +
           "\n* on the front: nothing here is as quick and more accurate; b: biased, more samples do not help\n"
           "cpu s: processor time of the samples; files and what is made before are not in it\n";
}

nlohmann::ordered_json trade_json(const TradeReport& report) {
    nlohmann::ordered_json j;
    j["version"] = PLUVIA_VERSION;
    j["scene"] = report.scene;
    j["settings"] = report.options;
    j["reference"] = {{"samples", report.reference_samples}, {"error", report.reference_error}};
    j["results"] = nlohmann::ordered_json::array();
    const std::vector<bool> front = pareto_front(report.results);
    for (size_t i = 0; i < report.results.size(); ++i) {
        const TradeResult& r = report.results[i];
        nlohmann::ordered_json result = {{"dial", r.dial},
                                         {"value", r.value},
                                         {"biased", r.biased},
                                         {"key", fmt::format("{:016x}", r.key)},
                                         {"samples", r.samples},
                                         {"build_cpu_s", r.build_cpu_s},
                                         {"cpu_s", r.cpu_s},
                                         {"wall_s", r.wall_s},
                                         {"background", layer_json(r.background)}};
        if (r.rainy) result["rainy"] = layer_json(*r.rainy);
        result["on_front"] = bool(front[i]);
        j["results"].push_back(result);
    }
    return j;
}

std::vector<TradeResult> trade_results(const nlohmann::ordered_json& json) {
    std::vector<TradeResult> results;
    for (const auto& j : json.at("results")) {
        TradeResult r;
        r.dial = j.at("dial"), r.value = j.at("value"), r.biased = j.at("biased");
        r.key = std::stoull(j.at("key").get<std::string>(), nullptr, 16);
        r.samples = j.at("samples");
        r.build_cpu_s = j.at("build_cpu_s"), r.cpu_s = j.at("cpu_s"), r.wall_s = j.at("wall_s");
        r.background = layer_from(j.at("background"));
        if (j.contains("rainy")) r.rainy = layer_from(j.at("rainy"));
        results.push_back(r);
    }
    return results;
}

}  // namespace pluvia
