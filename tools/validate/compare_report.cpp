#include "tools/validate/compare_report.h"

#include "renderer/core/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace pluvia {
namespace {

using Json = nlohmann::ordered_json;

std::string origin_text(const std::map<std::string, std::string>& origin) {
    std::vector<std::string> parts;
    for (const auto& [key, value] : origin) parts.push_back(key + " " + value);
    return parts.empty() ? "" : fmt::format(" ({})", fmt::join(parts, ", "));
}

std::string layer_text(const std::string& layer) {
    return layer.empty() ? "" : ", layer " + layer;
}

/// Columns as wide as their longest entry; the first one to the left, numbers to the right.
std::string align(const std::vector<std::vector<std::string>>& rows) {
    std::vector<size_t> widths;
    for (const auto& row : rows)
        for (size_t c = 0; c < row.size(); ++c) {
            if (widths.size() <= c) widths.push_back(0);
            widths[c] = std::max(widths[c], row[c].size());
        }
    std::string text;
    for (const auto& row : rows) {
        for (size_t c = 0; c < row.size(); ++c)
            text += c == 0 ? fmt::format("{:<{}}", row[c], widths[c]) : fmt::format("  {:>{}}", row[c], widths[c]);
        text += "\n";
    }
    return text;
}

const double* find(const Metrics& metrics, const std::string& name) {
    for (const auto& [key, value] : metrics)
        if (key == name) return &value;
    return nullptr;
}

std::string one_pair(const PairResult& pair) {
    std::vector<std::vector<std::string>> rows = {{"metric"}};
    for (const RegionMetrics& region : pair.regions) rows[0].push_back(region.name);
    for (const auto& entry : pair.regions[0].metrics) {
        rows.push_back({entry.first});
        for (const RegionMetrics& region : pair.regions)
            rows.back().push_back(metric_text(entry.first, *find(region.metrics, entry.first)));
        if (entry.first != "bias") continue;
        rows.push_back({"  95 % from"});
        for (const RegionMetrics& region : pair.regions) rows.back().push_back(metric_text("bias", region.bias_low));
        rows.push_back({"  to"});
        for (const RegionMetrics& region : pair.regions) rows.back().push_back(metric_text("bias", region.bias_high));
    }
    return align(rows);
}

std::string many_pairs(const std::vector<PairResult>& pairs) {
    std::string text;
    const auto means = mean_over_pairs(pairs);
    for (size_t r = 0; r < means.size(); ++r) {
        std::vector<std::vector<std::string>> rows = {{means[r].name}};
        for (const auto& entry : means[r].metrics) rows[0].push_back(entry.first);
        const auto add_row = [&](const std::string& name, const Metrics& metrics) {
            rows.push_back({name});
            for (const auto& entry : means[r].metrics) {
                const double* value = find(metrics, entry.first);
                rows.back().push_back(value ? metric_text(entry.first, *value) : "");
            }
        };
        for (const PairResult& pair : pairs) add_row(pair.name, pair.regions[r].metrics);
        add_row("mean", means[r].metrics);
        text += align(rows) + (r + 1 < means.size() ? "\n" : "");
    }
    return text;
}

Json to_json(const Metrics& metrics) {
    Json j = Json::object();
    for (const auto& [name, value] : metrics) j[name] = value;  // the library writes what is not finite as null
    return j;
}

Json to_json(const RegionMetrics& region) {
    Json j = to_json(region.metrics);
    if (j.contains("bias")) j["bias_interval_95"] = {region.bias_low, region.bias_high};
    return j;
}

}  // namespace

std::string metric_text(const std::string& metric, double value) {
    if (metric == "psnr") return fmt::format("{:.2f}", value);
    if (metric.starts_with("bias")) return fmt::format("{:+.3f} %", 100 * value);
    return fmt::format("{:.4g}", value);
}

std::string compare_table(const std::string& a, const std::string& b, const std::vector<PairResult>& pairs) {
    const PairResult& first = pairs[0];
    const bool is_single = pairs.size() == 1;
    std::string text =
        fmt::format("A {}{}{}\nB {}{}{}\n", a, is_single ? layer_text(first.layer_a) : "",
                    is_single ? origin_text(first.origin_a) : "", b, is_single ? layer_text(first.layer_b) : "",
                    is_single ? origin_text(first.origin_b) : "");
    if (is_single) {
        text += fmt::format("{}, {}x{}", picture_kind_name(first.kind), first.width, first.height);
        if (first.kind == PictureKind::light) text += fmt::format(", {:.4g} displays as white", first.white);
        text += "\n";
    }
    return text + "\n" + (is_single ? one_pair(first) : many_pairs(pairs));
}

Json compare_json(const std::string& a, const std::string& b, const std::vector<PairResult>& pairs) {
    Json j;
    j["version"] = PLUVIA_VERSION;
    j["a"] = a, j["b"] = b;
    for (const PairResult& pair : pairs) {
        Json p;
        p["name"] = pair.name, p["kind"] = picture_kind_name(pair.kind);
        p["width"] = pair.width, p["height"] = pair.height;
        if (!pair.layer_a.empty()) p["layer_a"] = pair.layer_a;
        if (!pair.layer_b.empty()) p["layer_b"] = pair.layer_b;
        if (!pair.origin_a.empty()) p["origin_a"] = pair.origin_a;
        if (!pair.origin_b.empty()) p["origin_b"] = pair.origin_b;
        if (pair.kind == PictureKind::light) p["white"] = pair.white;
        for (const RegionMetrics& region : pair.regions) p["regions"][region.name] = to_json(region);
        j["pairs"].push_back(p);
    }
    for (const RegionMetrics& region : mean_over_pairs(pairs)) j["mean"][region.name] = to_json(region.metrics);
    return j;
}

std::vector<std::string> beyond_limits(const std::vector<PairResult>& pairs, const std::vector<MetricLimit>& limits) {
    std::vector<std::string> lines;
    for (const MetricLimit& limit : limits) {
        bool known = false;
        for (const PairResult& pair : pairs)
            for (const RegionMetrics& region : pair.regions) {
                const double* value = find(region.metrics, limit.name);
                if (!value) continue;
                known = true;
                if (is_worse(limit, *value))
                    lines.push_back(fmt::format("{}, {}: {} is {:.6g} (limit {:g})", pair.name, region.name, limit.name,
                                                *value, limit.value));
            }
        if (!known)
            throw usage_error("--fail",
                              fmt::format("{} is not measured here (no pair of pictures has it)", limit.name));
    }
    return lines;
}

}  // namespace pluvia
