#include "renderer/rain/rain_medium.h"

#include "renderer/rain/drop_population.h"
#include "renderer/rain/drop_size.h"

#include <algorithm>

namespace pluvia {
namespace {

constexpr int cells = 1024;  // extinction bends slowly: the error of a linear cell is below 1e-4 of it beyond 1 m

/// Solves a s + b s^2 / 2 = c for the smallest s >= 0; a, b and c such that there is one.
float solve_quadratic(float a, float b, float c) {
    const float root = std::sqrt(std::max(0.0f, a * a + 2 * b * c));
    return a + root > 0 ? 2 * c / (a + root) : 0;
}

/// Distance over which a truncated exponential of this optical depth loses the share u of what it loses in all.
float sample_optical_depth(float total, float u) {
    return -std::log1p(u * std::expm1(-total));
}

}  // namespace

RainMedium::RainMedium(const View& view, const RainSettings& settings, bool drops)
    : intensities_(settings.intensities_mm_per_h.size()),
      row_size_(2 * (proposals + intensities_)),
      near_(float(settings.near)),
      bottom_(float(settings.lowest_ground)),
      top_(float(settings.lowest_ground + rain_height)),
      fog_extinction_(float(settings.fog_extinction)) {
    const double diameter_per_depth = settings.min_width_pixels / view.focal_pixels;
    const double step = largest_drop / diameter_per_depth / cells;
    step_ = float(step), steps_per_metre_ = float(1 / step);
    table_.resize((cells + 2) * row_size_);
    for (size_t p = 0; p < proposals + intensities_; ++p) {
        const double intensity =
            p < proposals ? proposal_intensities_mm_per_h[p] : settings.intensities_mm_per_h[p - proposals];
        add_profile(p, drops ? intensity : 0, step, diameter_per_depth);
    }
}

void RainMedium::add_profile(size_t profile, double intensity, double step, double diameter_per_depth) {
    double sum = 0, before = 0;
    for (int i = 0; i <= cells; ++i) {
        // The last step may be a rounding beyond the largest drop.
        const double widest = std::min(largest_drop, diameter_per_depth * step * i);
        const double here = pluvia::extinction(intensity, smallest_drop, widest);
        if (i > 0) sum += step * (before + here) / 2;
        float* const entry = table_.data() + size_t(i) * row_size_ + 2 * profile;
        entry[0] = float(here), entry[1] = float(sum);
        if (profile < proposals) proposal_depth_[profile].push_back(float(sum));
        before = here;
    }
    table_[(cells + 1) * row_size_ + 2 * profile] = float(before);  // farther away all drops are in the medium
}

RainMedium::Place RainMedium::place_at(float z) const {
    const float x = z * steps_per_metre_;
    const int row = x >= cells ? cells : int(x);
    return {table_.data() + size_t(row) * row_size_, x - float(row)};
}

float RainMedium::extinction(size_t profile, Place place) const {
    const float here = place.row[2 * profile];
    return here + place.s * (place.row[row_size_ + 2 * profile] - here);
}

float RainMedium::depth(size_t profile, Place place) const {
    const float here = place.row[2 * profile];
    return place.row[2 * profile + 1] +
           place.s * step_ * (here + 0.5f * place.s * (place.row[row_size_ + 2 * profile] - here));
}

float RainMedium::find_depth(size_t proposal, float depth) const {
    const std::vector<float>& depths = proposal_depth_[proposal];
    const auto row = size_t(std::upper_bound(depths.begin(), depths.end(), depth) - depths.begin()) - 1;
    const float* const here = table_.data() + row * row_size_ + 2 * proposal;
    const float left = depth - here[1];
    if (row == cells) return step_ * cells + left / here[0];
    const float s = solve_quadratic(here[0], here[row_size_] - here[0], left * steps_per_metre_);
    return step_ * (float(row) + std::min(s, 1.0f));
}

RainSegment RainMedium::segment(const Ray& ray, float cosine) const {
    RainSegment s{near_ / cosine, std::min(ray.t_max, float(longest_rain_path)), cosine};
    const float rise = ray.direction.y, y = ray.origin.y;
    if (rise != 0) {
        const float a = (bottom_ - y) / rise, b = (top_ - y) / rise;
        s.begin = std::max(s.begin, std::min(a, b));
        s.end = std::min(s.end, std::max(a, b));
    } else if (y < bottom_ || y > top_) {
        s.end = s.begin;
    }
    return s;
}

bool RainMedium::is_dry(const RainSegment& segment, float distance) {
    for (const DryPart& part : segment.dry)
        if (distance < part.end) return distance >= part.begin;
    return false;
}

void RainMedium::optical_depths(const RainSegment& segment, float distance, float* depths) const {
    const auto add = [&](float from, float to, float sign) {
        const Place begin = place_at(from * segment.cosine), end = place_at(to * segment.cosine);
        for (size_t i = 0; i < intensities_; ++i)
            depths[i] += sign * (depth(proposals + i, end) - depth(proposals + i, begin)) / segment.cosine;
    };
    std::fill(depths, depths + intensities_, 0.0f);
    add(segment.begin, distance, 1);
    for (const DryPart& part : segment.dry) {
        const float begin = std::max(part.begin, segment.begin), end = std::min(part.end, distance);
        if (begin < end) add(begin, end, -1);
    }
    for (size_t i = 0; i < intensities_; ++i) depths[i] = std::max(0.0f, depths[i]);
}

void RainMedium::axis_depths(float z, float* depths) const {
    const Place place = place_at(z);
    for (size_t i = 0; i < intensities_; ++i) depths[i] = depth(proposals + i, place);
}

bool RainMedium::total_depths(const RainSegment& segment, std::array<float, proposals>& totals) const {
    const Place begin = place_at(segment.begin * segment.cosine), end = place_at(segment.end * segment.cosine);
    bool any = true;
    for (size_t p = 0; p < proposals; ++p) {
        totals[p] = (depth(p, end) - depth(p, begin)) / segment.cosine;
        any = any && totals[p] > 0;
    }
    return any;
}

void RainMedium::sample(Scatterer scatterer, const RainSegment& segment, float u, Scattering& result) const {
    result.distance = 0;
    float distance, density;
    if (scatterer == Scatterer::fog) {
        if (!has_fog()) return;
        distance = segment.begin + sample_optical_depth(fog_depth(segment, segment.end), u) / fog_extinction_;
        distance = std::clamp(distance, segment.begin, segment.end);
        density = pdf(scatterer, segment, distance);
    } else {
        std::array<float, proposals> totals;
        if (!total_depths(segment, totals)) return;  // all drops on the segment are resolved
        const float chosen = u * float(proposals);
        const size_t c = std::min(size_t(chosen), proposals - 1);
        const float begin = depth(c, place_at(segment.begin * segment.cosine));
        const float behind = sample_optical_depth(totals[c], chosen - float(c)) * segment.cosine;
        distance = std::clamp(find_depth(c, begin + behind) / segment.cosine, segment.begin, segment.end);
        density = drop_pdf(segment, totals, distance);
    }
    // On the very edge of the medium its extinction may round to 0.
    if (density > 0) weigh(scatterer, segment, distance, density, result);
}

float RainMedium::pdf(Scatterer scatterer, const RainSegment& segment, float distance) const {
    if (scatterer == Scatterer::fog)
        return fog_extinction_ * std::exp(-fog_depth(segment, distance)) /
               -std::expm1(-fog_depth(segment, segment.end));
    std::array<float, proposals> totals;
    return total_depths(segment, totals) ? drop_pdf(segment, totals, distance) : 0;
}

float RainMedium::drop_pdf(const RainSegment& segment, const std::array<float, proposals>& totals,
                           float distance) const {
    const Place begin = place_at(segment.begin * segment.cosine), here = place_at(distance * segment.cosine);
    float sum = 0;
    for (size_t p = 0; p < proposals; ++p) {
        const float before = std::max(0.0f, (depth(p, here) - depth(p, begin)) / segment.cosine);
        sum += extinction(p, here) * std::exp(-before) / -std::expm1(-totals[p]);
    }
    return sum / float(proposals);
}

void RainMedium::weigh(Scatterer scatterer, const RainSegment& segment, float distance, float pdf,
                       Scattering& result) const {
    result.distance = distance;
    result.weights.assign(intensities_, 0.0f);
    if (scatterer == Scatterer::drop && is_dry(segment, distance)) return;
    const float fog = fog_depth(segment, distance);
    const Place here = place_at(distance * segment.cosine);
    optical_depths(segment, distance, result.weights.data());
    for (size_t i = 0; i < intensities_; ++i) {
        const float scattering = scatterer == Scatterer::fog ? fog_extinction_ : extinction(proposals + i, here);
        result.weights[i] = scattering * std::exp(-result.weights[i] - fog) / pdf;
    }
}

}  // namespace pluvia
