#include "renderer/core/random.h"

namespace pluvia {
namespace {

constexpr uint32_t reverse_bits(uint32_t v) {
    v = __builtin_bswap32(v);
    v = ((v >> 4) & 0x0f0f0f0fu) | ((v & 0x0f0f0f0fu) << 4);
    v = ((v >> 2) & 0x33333333u) | ((v & 0x33333333u) << 2);
    return ((v >> 1) & 0x55555555u) | ((v & 0x55555555u) << 1);
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
constexpr uint32_t owen_scramble(uint32_t v, uint32_t seed) {
    return reverse_bits(permute_upwards(reverse_bits(v), seed));
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

constexpr float unit_from_u32(uint32_t v) {
    return float(v >> 8) * 0x1p-24f;
}

}  // namespace

Vec2 Sampler::get_2d(Draw draw, uint32_t bounce) const {
    const uint64_t h = hash_key(pixel_key_, (uint64_t(bounce) << 32) | uint32_t(draw));
    const uint64_t g = mix_bits(h + 0x9e3779b97f4a7c15ull);
    // Shuffling in the order of reversed digits keeps every power-of-two prefix stratified.
    const uint32_t index = owen_scramble(sample_, uint32_t(h));
    // First dimension: digits reversed (van der Corput), then scrambled; the two reversals cancel.
    const uint32_t x = reverse_bits(permute_upwards(index, uint32_t(h >> 32)));
    const uint32_t y = reverse_bits(permute_upwards(pascal(index), uint32_t(g)));
    return {unit_from_u32(x), unit_from_u32(y)};
}

}  // namespace pluvia
