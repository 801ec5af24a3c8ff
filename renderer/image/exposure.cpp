#include "renderer/image/exposure.h"

#include <algorithm>
#include <cmath>

namespace pluvia {
namespace {

constexpr double saturation_factor = 1.2;  // 78 / (100 * q) with q = 0.65; ISO 12232, Lagarde and de Rousiers 2014
constexpr double dark_limit_stop = 6;  // log2 of 64 cd/m2
constexpr double mid_grey = 0.18;
constexpr double low_percentile = 0.05, high_percentile = 0.95;

}  // namespace

float exposure_scale(double ev100) { return float(1 / (saturation_factor * std::exp2(ev100))); }

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
    const double mean_stop = log_sum / weight_sum;
    // Darker than a bright room: each stop less of light is shown as a quarter of a stop less, down to two stops.
    const double below_day = std::max(0.0, dark_limit_stop - mean_stop);
    const double shown_grey = mid_grey * std::exp2(-std::min(2.0, below_day / 4));
    const double ev100 = mean_stop - std::log2(shown_grey * saturation_factor);
    return std::clamp(ev100, min_auto_ev100, max_auto_ev100);
}

}  // namespace pluvia
