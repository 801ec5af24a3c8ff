#include "tools/validate/metric_list.h"

#include "renderer/core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pluvia {

const std::vector<MetricInfo>& metric_list() {
    static const std::vector<MetricInfo> list = {
        {"mse", Better::low, "mean over pixels and channels of (A - B)^2"},
        {"relmse", Better::low, "mean over pixels and channels of (A - B)^2 / (B^2 + 0.01)"},
        {"relmse_trimmed", Better::low, "relmse without the 0.1 % of pixels where it is largest (rounded down)"},
        {"bias", Better::zero,
         "(mean A - mean B) / mean B; with its interval of 95 %: 1.96 standard deviations of the\n"
         "pixels' differences / sqrt(pixels)"},
        {"bias_r", Better::zero, "the same of the red channel"},
        {"bias_g", Better::zero, "of green"},
        {"bias_b", Better::zero, "of blue"},
        {"psnr", Better::high,
         "10 log10(1 / (MSE + 1e-8)) in dB, MSE of displayed values 0..1; equal pictures have 80"},
        {"ssim", Better::high,
         "Wang et al. 2004 of displayed values 0..1, per channel: Gaussian window, 11 taps, sigma\n"
         "1.5, inside the picture only, K1 0.01, K2 0.03; mean over positions and channels"},
        {"flip_ldr", Better::low, "FLIP (Andersson et al. 2020), mean over pixels, of what a screen shows"},
        {"flip_hdr", Better::low, "HDR-FLIP (Andersson et al. 2021), tone curve of ACES; of light only"},
        {"abs_rel", Better::low, "depth: mean |A - B| / B where both have a depth"},
        {"rmse", Better::low, "depth: root of the mean (A - B)^2 there, metres"},
        {"delta1", Better::high, "depth: share of B's depths where max(A/B, B/A) < 1.25; none in A counts as missed"},
        {"delta2", Better::high, "the same with 1.25^2"},
        {"delta3", Better::high, "the same with 1.25^3"},
        {"missing", Better::low, "depth: share of B's depths where A has none"},
        {"iou", Better::high, "mask: pixels set in both / set in either; 1 where both are empty"},
        {"precision", Better::high, "mask: set in both / set in A"},
        {"recall", Better::high, "mask: set in both / set in B"},
    };
    return list;
}

const MetricInfo& metric_info(const std::string& name) {
    std::string lower = name;
    std::transform(name.begin(), name.end(), lower.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    if (lower == "lpips" || lower == "fid")
        throw usage_error("--fail", name +
                                        " is not computed: it is a number of trained networks, whose weights do not "
                                        "come with Pluvia and which it cannot run");
    std::string names;
    for (const MetricInfo& info : metric_list()) {
        if (lower == info.name) return info;
        names += std::string(names.empty() ? "" : ", ") + info.name;
    }
    throw usage_error("--fail", fmt::format("does not know this metric (got \"{}\", expected {})", name, names));
}

std::string metric_definitions() {
    std::string text;
    for (const MetricInfo& info : metric_list()) {
        std::string definition = info.definition;
        const std::string indent(18, ' ');
        for (size_t at = 0; (at = definition.find('\n', at)) != std::string::npos; at += indent.size() + 1)
            definition.insert(at + 1, indent);
        text += fmt::format("  {:<16}{}\n", info.name, definition);
    }
    return text;
}

MetricLimit parse_limit(const std::string& text) {
    const size_t equals = text.find('=');
    if (equals == std::string::npos)
        throw usage_error("--fail", fmt::format("is not a limit (got \"{}\", expected METRIC=VALUE)", text));
    MetricLimit limit{metric_info(text.substr(0, equals)).name, 0};
    const std::string number = text.substr(equals + 1);
    size_t used = 0;
    try {
        limit.value = std::stod(number, &used);
    } catch (const std::exception&) {
    }
    if (used == 0 || used != number.size() || !std::isfinite(limit.value))
        throw usage_error("--fail", fmt::format("has no number behind {}= (got \"{}\")", limit.name, number));
    return limit;
}

bool is_worse(const MetricLimit& limit, double value) {
    switch (metric_info(limit.name).better) {
        case Better::low:
            return !(value <= limit.value);
        case Better::high:
            return !(value >= limit.value);
        default:
            return !(std::abs(value) <= limit.value);
    }
}

}  // namespace pluvia
