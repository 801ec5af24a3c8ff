// Random numbers as pure functions: of (seed, pixel, sample, dimension) for light paths, of a key for everything else.
// There is no generator state, so neither tiles nor threads can change a picture.
#pragma once

#include "renderer/core/vec.h"

#include <array>
#include <cstdint>
#include <span>

namespace pluvia {

/// Mixes 64 bits so that every input bit changes every output bit with probability one half.
/// Source: Stafford 2011, "Better Bit Mixing", variant 13.
constexpr uint64_t mix_bits(uint64_t v) {
    v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9ull;
    v = (v ^ (v >> 27)) * 0x94d049bb133111ebull;
    return v ^ (v >> 31);
}

/// Folds values into one 64-bit key; the order of the values matters.
template <class... Values>
constexpr uint64_t hash_key(uint64_t first, Values... rest) {
    uint64_t h = mix_bits(first + 0x9e3779b97f4a7c15ull);
    ((h = mix_bits(h ^ (uint64_t(rest) + 0x9e3779b97f4a7c15ull + (h << 6)))), ...);
    return h;
}

/// Uniform in [0, 1) from the top 24 bits, so that float rounding cannot reach 1.
constexpr float unit_float(uint64_t bits) {
    return float(bits >> 40) * 0x1p-24f;
}
/// Uniform in [0, 1) from the top 53 bits.
constexpr double unit_double(uint64_t bits) {
    return double(bits >> 11) * 0x1p-53;
}

/// What a random number decides. Each belongs to a domain of its own, so that a feature that starts or stops asking
/// shifts no other feature's numbers. Those of a vertex come first: they are computed together.
enum class Draw : uint32_t {
    lobe,
    bsdf,
    light_choice,
    light_point,
    sky_point,
    sun_point,
    light_pick,
    roulette,
    pixel,
    lens,
    opacity,
    streak_choice,
    streak_phase,
    medium_distance,
    medium_anchor,
};
constexpr uint32_t first_draws = 8;

/// The first draws of one vertex of a path.
class VertexNumbers {
public:
    Vec2 get_2d(Draw draw) const { return {x[uint32_t(draw)], y[uint32_t(draw)]}; }
    float get_1d(Draw draw) const { return x[uint32_t(draw)]; }

private:
    friend class Sampler;
    std::array<float, first_draws> x, y;
};

/// The numbers of one camera sample: low-discrepancy over the samples of a pixel, independent between pixels and draws.
/// Owen-scrambled Sobol points in pairs of dimensions, each pair with a shuffle of its own.
/// Source: Burley 2020, "Practical Hash-based Owen Scrambling", JCGT 9(4).
class Sampler {
public:
    Sampler(uint64_t seed, uint32_t pixel_x, uint32_t pixel_y, uint32_t sample)
        : pixel_key_(hash_key(seed, (uint64_t(pixel_y) << 32) | pixel_x)), sample_(sample) {}

    /// Uniform in [0, 1). bounce: which vertex of the path asks.
    float get_1d(Draw draw, uint32_t bounce = 0) const { return get_2d(draw, bounce).x; }
    /// Uniform in [0, 1)^2.
    Vec2 get_2d(Draw draw, uint32_t bounce = 0) const;
    /// The same numbers as get_2d for all of the first draws, at about the price of two.
    VertexNumbers vertex(uint32_t bounce) const;
    /// The same numbers as get_2d(draw) for camera samples of a pixel, the given one and those that follow it, at a
    /// fraction of the price of each.
    void get_2d(Draw draw, std::span<Vec2> of_samples) const;

    /// A key to be hashed further. It differs between all samples, draws and bounces but is not mixed.
    uint64_t key(Draw draw, uint32_t bounce = 0) const {
        return pixel_key_ + sample_ * 0x9e3779b97f4a7c15ull +
               ((uint64_t(bounce) << 32) | uint32_t(draw)) * 0xc2b2ae3d27d4eb4full;
    }
    /// The same camera sample seen by another, independent part of the program.
    Sampler fork(uint64_t domain) const {
        Sampler other = *this;
        other.pixel_key_ = hash_key(pixel_key_, domain);
        return other;
    }

private:
    uint64_t pixel_key_;
    uint32_t sample_;
};

}  // namespace pluvia
