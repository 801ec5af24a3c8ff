#include "renderer/core/random.h"

namespace pluvia {
namespace {

// Shifts and masks alone: a byte swap would keep compilers from working on several numbers at a time.
constexpr uint32_t reverse_bits(uint32_t v) {
    v = (v >> 16) | (v << 16);
    v = ((v >> 8) & 0x00ff00ffu) | ((v & 0x00ff00ffu) << 8);
    v = ((v >> 4) & 0x0f0f0f0fu) | ((v & 0x0f0f0f0fu) << 4);
    v = ((v >> 2) & 0x33333333u) | ((v & 0x33333333u) << 2);
    return ((v >> 1) & 0x55555555u) | ((v & 0x55555555u) << 1);
}

/// Mixes 32 bits. Source: Wellons 2018, "Prospecting for Hash Functions", lowbias32.
constexpr uint32_t mix_bits(uint32_t v) {
    v = (v ^ (v >> 16)) * 0x7feb352du;
    v = (v ^ (v >> 15)) * 0x846ca68bu;
    return v ^ (v >> 16);
}

/// A random permutation in which bit n depends only on the bits below it: a nested uniform scramble of the reversed
/// number. Source: Laine and Karras 2011, section 3.1, with the constants of Vegdahl 2021, "Owen scrambling based
/// hashes revisited".
constexpr uint32_t permute_upwards(uint32_t v, uint32_t seed) {
    v ^= v * 0x3d20adeau;
    v += seed;
    v *= (seed >> 16) | 1;
    v ^= v * 0x05526c56u;
    v ^= v * 0x53a22864u;
    return v;
}

/// Second dimension of the Sobol sequence with its digits reversed: multiplication by the Pascal matrix modulo 2,
/// whose n-th step shifts by a power of two because binomials modulo 2 factor over the digits (Lucas 1878).
constexpr uint32_t pascal(uint32_t v) {
    v ^= (v & 0xaaaaaaaau) >> 1;
    v ^= (v & 0xccccccccu) >> 2;
    v ^= (v & 0xf0f0f0f0u) >> 4;
    v ^= (v & 0xff00ff00u) >> 8;
    v ^= (v & 0xffff0000u) >> 16;
    return v;
}

/// Point number `sample` of a scrambled and shuffled Sobol pair. reversed_sample: its digits reversed; key: of pixel
/// and bounce; draw: which pair.
constexpr void sobol_pair(uint32_t reversed_sample, uint64_t key, uint32_t draw, float& x, float& y) {
    const uint32_t order = mix_bits(uint32_t(key) + draw * 0x9e3779b9u);
    const uint32_t scramble_x = mix_bits(uint32_t(key >> 32) + draw * 0x85ebca6bu);
    const uint32_t scramble_y = mix_bits(order ^ (scramble_x * 0xc2b2ae35u));
    // Shuffling in the order of reversed digits keeps every power-of-two prefix stratified.
    const uint32_t index = reverse_bits(permute_upwards(reversed_sample, order));
    // First dimension: digits reversed (van der Corput), then scrambled; the two reversals cancel.
    const uint32_t u = reverse_bits(permute_upwards(index, scramble_x));
    const uint32_t v = reverse_bits(permute_upwards(pascal(index), scramble_y));
    // 24 bits, so that float rounding cannot reach 1; signed, because that conversion is the faster one.
    x = float(int32_t(u >> 8)) * 0x1p-24f;
    y = float(int32_t(v >> 8)) * 0x1p-24f;
}

}  // namespace

Vec2 Sampler::get_2d(Draw draw, uint32_t bounce) const {
    Vec2 u;
    sobol_pair(reverse_bits(sample_), hash_key(pixel_key_, bounce), uint32_t(draw), u.x, u.y);
    return u;
}

void Sampler::get_2d(Draw draw, std::span<Vec2> of_samples) const {
    const uint64_t key = hash_key(pixel_key_, 0);
    for (uint32_t i = 0; i < of_samples.size(); ++i)
        sobol_pair(reverse_bits(sample_ + i), key, uint32_t(draw), of_samples[i].x, of_samples[i].y);
}

VertexNumbers Sampler::vertex(uint32_t bounce) const {
    VertexNumbers numbers;
    const uint32_t reversed_sample = reverse_bits(sample_);
    const uint64_t key = hash_key(pixel_key_, bounce);
    for (uint32_t draw = 0; draw < first_draws; ++draw)
        sobol_pair(reversed_sample, key, draw, numbers.x[draw], numbers.y[draw]);
    return numbers;
}

}  // namespace pluvia
