// A counter per feature: what a scene does not need must show zero calls.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace pluvia {

enum class Feature {
    camera_path,
    texture,
    normal_map,
    vertex_color,
    alpha,
    emissive_surface,
    pane,
    frosted_pane,
    glass,
    volume,
    clearcoat,
    sheen,
    anisotropy,
    unlit,
    local_light,
    distant_light,
    guided_sky,
    environment,
    lens,
    streak_test,
    streak_hit,
    streak_path,
    paper_streak,
    medium_point,
    medium_path,
    medium_lamp,
    rain_shadow,
    wet_surface,
    puddle,
    ripples,
    label,
    matte,
    count,
};

constexpr std::array<const char*, std::size_t(Feature::count)> feature_names = {
    "camera_path",  "texture",       "normal_map",   "vertex_color", "alpha",       "emissive_surface", "pane",
    "frosted_pane", "glass",         "volume",       "clearcoat",    "sheen",       "anisotropy",       "unlit",
    "local_light",  "distant_light", "guided_sky",   "environment",  "lens",        "streak_test",      "streak_hit",
    "streak_path",  "paper_streak",  "medium_point", "medium_path",  "medium_lamp", "rain_shadow",      "wet_surface",
    "puddle",       "ripples",       "label",        "matte"};

/// Each worker has its own; sums are exact whatever the order.
struct Counters {
    std::array<uint64_t, std::size_t(Feature::count)> calls = {};
    uint64_t rays = 0;             // closest-hit and shadow queries
    uint64_t invalid_samples = 0;  // radiance that was not finite, left out of the picture and reported

    void count(Feature feature, uint64_t times = 1) { calls[std::size_t(feature)] += times; }
    uint64_t operator[](Feature feature) const { return calls[std::size_t(feature)]; }
    Counters& operator+=(const Counters& other) {
        for (std::size_t i = 0; i < calls.size(); ++i) calls[i] += other.calls[i];
        rays += other.rays;
        invalid_samples += other.invalid_samples;
        return *this;
    }
};

}  // namespace pluvia
