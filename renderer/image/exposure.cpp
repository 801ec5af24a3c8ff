#include "renderer/image/exposure.h"

#include <algorithm>
#include <cmath>

namespace pluvia {
namespace {

constexpr double saturation_factor = 1.2;      // 78 / (100 * q) with q = 0.65; ISO 12232, Lagarde and de Rousiers 2014
constexpr double meter_constant = 12.5 / 100;  // K over ISO 100
constexpr double day_ev = 8, night_ev = 4, night_loss = 0.5;
constexpr double dark_ev = 1, dark_slope = 0.25;
constexpr double low_percentile = 0.05, high_percentile = 0.95;

}  // namespace

float exposure_scale(double ev100) {
    return float(1 / (saturation_factor * std::exp2(ev100)));
}

void LuminanceHistogram::add(Rgb radiance) {
    const float y = luminance(radiance);
    if (!(y > 0)) return;
    const float position = (std::log2(y) - min_stop) * bins_per_stop;
    ++counts_[std::size_t(std::clamp(position, 0.0f, float(bin_count - 1)))];
}

void LuminanceHistogram::merge(const LuminanceHistogram& other) {
    for (int i = 0; i < bin_count; ++i) counts_[std::size_t(i)] += other.counts_[std::size_t(i)];
}

double LuminanceHistogram::auto_ev100() const {
    double total = 0;
    for (const uint64_t count : counts_) total += double(count);
    if (total == 0) return 0;
    const double low = low_percentile * total, high = high_percentile * total;
    double before = 0, weight_sum = 0, log_sum = 0;
    for (int i = 0; i < bin_count; ++i) {
        const double after = before + double(counts_[std::size_t(i)]);
        // The part of the bin between the percentiles; a picture of one value keeps 90 % of its only bin.
        const double weight = std::max(0.0, std::min(after, high) - std::max(before, low));
        weight_sum += weight;
        log_sum += weight * (min_stop + (i + 0.5) / bins_per_stop);
        before = after;
    }
    const double metered = log_sum / weight_sum - std::log2(meter_constant);
    double ev100 = metered + night_loss * std::clamp((day_ev - metered) / (day_ev - night_ev), 0.0, 1.0);
    if (ev100 < dark_ev) ev100 = dark_ev + dark_slope * (ev100 - dark_ev);
    return std::clamp(ev100, min_auto_ev100, max_auto_ev100);
}

}  // namespace pluvia
