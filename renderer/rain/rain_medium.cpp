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

RainMedium::Profile RainMedium::make_profile(double intensity, double step, double diameter_per_depth) {
    Profile profile;
    profile.extinction.resize(cells + 1), profile.depth.resize(cells + 1);
    double depth = 0, before = 0;
    for (int i = 0; i <= cells; ++i) {
        // The last step may be a rounding beyond the largest drop.
        const double widest = std::min(largest_drop, diameter_per_depth * step * i);
        const double here = extinction(intensity, smallest_drop, widest);
        if (i > 0) depth += step * (before + here) / 2;
        profile.extinction[i] = float(here), profile.depth[i] = float(depth);
        before = here;
    }
    return profile;
}

RainMedium::RainMedium(const View& view, const RainSettings& settings, bool drops)
    : near_(float(settings.near)),
      bottom_(float(settings.lowest_ground)),
      top_(float(settings.lowest_ground + rain_height)),
      fog_extinction_(float(settings.fog_extinction)) {
    const double diameter_per_depth = settings.min_width_pixels / view.focal_pixels;
    const double step = largest_drop / diameter_per_depth / cells;
    step_ = float(step), steps_per_metre_ = float(1 / step);
    for (const double intensity : settings.intensities_mm_per_h)
        profiles_.push_back(make_profile(drops ? intensity : 0, step, diameter_per_depth));
    for (size_t i = 0; i < proposal_.size(); ++i)
        proposal_[i] = make_profile(drops ? proposal_intensities_mm_per_h[i] : 0, step, diameter_per_depth);
}

float RainMedium::extinction_at(const Profile& p, float z) const {
    const float x = z * steps_per_metre_;
    if (x >= cells) return p.extinction[cells];
    const int i = int(x);
    return p.extinction[i] + (x - float(i)) * (p.extinction[i + 1] - p.extinction[i]);
}

float RainMedium::depth_at(const Profile& p, float z) const {
    const float x = z * steps_per_metre_;
    if (x >= cells) return p.depth[cells] + (x - cells) * step_ * p.extinction[cells];
    const int i = int(x);
    const float s = x - float(i);
    return p.depth[i] + s * step_ * (p.extinction[i] + 0.5f * s * (p.extinction[i + 1] - p.extinction[i]));
}

float RainMedium::find_depth(const Profile& p, float depth) const {
    if (depth >= p.depth[cells]) return step_ * cells + (depth - p.depth[cells]) / p.extinction[cells];
    const int i = int(std::upper_bound(p.depth.begin(), p.depth.end(), depth) - p.depth.begin()) - 1;
    const float rise = p.extinction[i + 1] - p.extinction[i];
    const float s = solve_quadratic(p.extinction[i], rise, (depth - p.depth[i]) * steps_per_metre_);
    return step_ * (float(i) + std::min(s, 1.0f));
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

float RainMedium::wet_depth_between(const Profile& p, const RainSegment& segment, float distance) const {
    float depth = depth_between(p, segment, distance);
    for (const DryPart& part : segment.dry) {
        const float begin = std::max(part.begin, segment.begin), end = std::min(part.end, distance);
        if (end <= begin) continue;
        depth -= (depth_at(p, end * segment.cosine) - depth_at(p, begin * segment.cosine)) / segment.cosine;
    }
    return std::max(0.0f, depth);
}

void RainMedium::optical_depths(const RainSegment& segment, float distance, float* depths) const {
    for (size_t i = 0; i < profiles_.size(); ++i) depths[i] = wet_depth_between(profiles_[i], segment, distance);
}

void RainMedium::sample(Scatterer scatterer, const RainSegment& segment, float u, Scattering& result) const {
    result.distance = 0;
    float distance;
    if (scatterer == Scatterer::fog) {
        if (!has_fog()) return;
        distance = segment.begin + sample_optical_depth(fog_depth(segment, segment.end), u) / fog_extinction_;
    } else {
        const float chosen = u * float(proposal_.size());
        const size_t c = std::min(size_t(chosen), proposal_.size() - 1);
        const Profile& profile = proposal_[c];
        const float total = depth_between(profile, segment, segment.end);
        if (!(total > 0)) return;  // all drops on the segment are resolved
        const float depth = sample_optical_depth(total, chosen - float(c)) * segment.cosine;
        distance = find_depth(profile, depth_at(profile, segment.begin * segment.cosine) + depth) / segment.cosine;
    }
    distance = std::clamp(distance, segment.begin, segment.end);
    const float density = pdf(scatterer, segment, distance);
    // On the very edge of the medium its extinction may round to 0.
    if (density > 0) weigh(scatterer, segment, distance, density, result);
}

float RainMedium::pdf(Scatterer scatterer, const RainSegment& segment, float distance) const {
    if (scatterer == Scatterer::fog)
        return fog_extinction_ * std::exp(-fog_depth(segment, distance)) /
               -std::expm1(-fog_depth(segment, segment.end));
    float sum = 0;
    for (const Profile& profile : proposal_) {
        const float total = depth_between(profile, segment, segment.end);
        if (!(total > 0)) return 0;
        sum += extinction_at(profile, distance * segment.cosine) *
               std::exp(-depth_between(profile, segment, distance)) / -std::expm1(-total);
    }
    return sum / float(proposal_.size());
}

void RainMedium::weigh(Scatterer scatterer, const RainSegment& segment, float distance, float pdf,
                       Scattering& result) const {
    result.distance = distance;
    result.weights.resize(profiles_.size());
    const float fog = fog_depth(segment, distance), z = distance * segment.cosine;
    if (scatterer == Scatterer::drop && is_dry(segment, distance)) {
        std::fill(result.weights.begin(), result.weights.end(), 0.0f);
        return;
    }
    for (size_t i = 0; i < profiles_.size(); ++i) {
        const float scattering = scatterer == Scatterer::fog ? fog_extinction_ : extinction_at(profiles_[i], z);
        result.weights[i] = scattering * std::exp(-wet_depth_between(profiles_[i], segment, distance) - fog) / pdf;
    }
}

}  // namespace pluvia
