#include "renderer/transport/sky_guide.h"

#include "renderer/core/random.h"

#include <algorithm>
#include <cmath>

namespace pluvia {
namespace {

constexpr int levels = 4, bits_per_level = 2;  // cells of a level are 4 times as wide as those of the level below
constexpr float finest_cell = 0.5f;            // metres
/// Part of the samples that is drawn as if nothing were known. What is visible against expectation weighs at most the
/// inverse of this more than it would then.
constexpr float unguided = 0.1f;
/// Sights that what is known of the larger cell counts for.
constexpr float sights_of_larger = 20;
/// Where there are fewer, the larger cell serves: a cell takes a kilobyte.
constexpr size_t least_sights = 16;
/// What a sight in a block says of it and of those around it, in sixteenths: blocks are not much wider than gaps
/// between roofs.
constexpr std::array<uint32_t, 9> spread = {4, 2, 2, 2, 2, 1, 1, 1, 1};

/// Bits of a number below 2^19 with two empty ones between them.
uint64_t spread_bits(uint64_t v) {
    v = (v | v << 32) & 0x001f00000000ffffull;
    v = (v | v << 16) & 0x001f0000ff0000ffull;
    v = (v | v << 8) & 0x100f00f00f00f00full;
    v = (v | v << 4) & 0x10c30c30c30c30c3ull;
    return (v | v << 2) & 0x1249249249249249ull;
}

/// Side, and place in cells of finest_cell: three coordinates bit by bit in turn, so that cells of all levels are
/// ranges. Places more than 2^18 cells away count as the outermost.
uint64_t place_of(const Receiver& receiver) {
    const Vec3 n = receiver.normal;
    uint64_t side = 6;  // light comes through as well
    if (!(n == Vec3())) {
        const float x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z);
        const int axis = y >= x && y >= z ? 1 : x >= z ? 0 : 2;
        side = uint64_t(axis) * 2 + (n[axis] < 0 ? 1 : 0);
    }
    uint64_t place = side << 57;
    for (int axis = 0; axis < 3; ++axis) {
        constexpr float half = 1 << 18;
        const float cell = std::clamp(std::floor(receiver.position[axis] / finest_cell), -half, half - 1);
        place |= spread_bits(uint64_t(int64_t(cell) + int64_t(half))) << axis;
    }
    return place;
}

/// Above 0.
uint64_t key_at(uint64_t place, int level) {
    return (place >> (3 * bits_per_level * level) << 2 | uint64_t(level)) + 1;
}

}  // namespace

SkyGuide::SkyGuide(const Environment& environment, const std::vector<SkySight>& sights)
    : environment_(&environment), index_of_block_(Environment::block_count, 0) {
    find_blocks();
    std::vector<Sight> all;
    for (const SkySight& sight : sights)
        if (environment.block(sight.block).probability > 0)
            all.push_back({place_of(sight.receiver), index_of_block_[size_t(sight.block)]});
    std::sort(all.begin(), all.end(), [](const Sight& a, const Sight& b) { return a.place < b.place; });
    learn_cells(all, levels - 1, Shares(lit_blocks_.size(), 1 / float(lit_blocks_.size())));
    fill_slots();
}

void SkyGuide::find_blocks() {
    const auto shines = [&](int block) { return environment_->block(block).probability > 0; };
    for (int b = 0; b < Environment::block_count; ++b) {
        if (!shines(b)) continue;
        const Environment::Block& block = environment_->block(b);
        index_of_block_[size_t(b)] = int(lit_blocks_.size());
        lit_blocks_.push_back(b);
        radiance_.push_back(block.probability / block.solid_angle);
        per_probability_.push_back(float(1 / block.probability));
    }
    constexpr int rows = Environment::block_rows, columns = Environment::block_columns;
    constexpr std::array<std::array<int, 2>, 9> steps = {
        {{0, 0}, {0, 1}, {0, -1}, {1, 0}, {-1, 0}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};
    for (const int block : lit_blocks_) {
        std::array<int, 9>& near = near_.emplace_back();
        for (size_t k = 0; k < near.size(); ++k) {
            const int row = std::clamp(block / columns + steps[k][0], 0, rows - 1);
            const int b = row * columns + (block + steps[k][1] + columns) % columns;
            near[k] = index_of_block_[size_t(shines(b) ? b : block)];
        }
    }
}

void SkyGuide::learn_cells(std::span<const Sight> sights, int level, const Shares& larger) {
    for (size_t begin = 0, end; begin < sights.size(); begin = end) {
        const uint64_t key = key_at(sights[begin].place, level);
        for (end = begin; end < sights.size() && key_at(sights[end].place, level) == key;) ++end;
        if (end - begin < least_sights) continue;
        const std::span<const Sight> within = sights.subspan(begin, end - begin);
        const Shares shares = shares_of(within, larger);
        keys_.push_back(key);
        add_cell(shares);
        if (level > 0) learn_cells(within, level - 1, shares);
    }
}

SkyGuide::Shares SkyGuide::shares_of(std::span<const Sight> sights, const Shares& larger) const {
    // Whole numbers, so that the order of the sights does not matter.
    std::vector<uint32_t> sixteenths(larger.size());
    for (const Sight& sight : sights)
        for (size_t k = 0; k < spread.size(); ++k) sixteenths[size_t(near_[size_t(sight.block)][k])] += spread[k];
    const float sum = float(sights.size()) + sights_of_larger;
    Shares shares(larger.size());
    for (size_t b = 0; b < larger.size(); ++b)
        shares[b] = (float(sixteenths[b]) / 16 + larger[b] * sights_of_larger) / sum;
    return shares;
}

void SkyGuide::add_cell(const Shares& shares) {
    double sum = 0, before = 0;
    for (size_t b = 0; b < shares.size(); ++b) sum += shares[b] * radiance_[b];
    const size_t begin = parts_.size();
    for (size_t b = 0; b < shares.size(); ++b) {
        before += shares[b] * radiance_[b];
        parts_.resize(begin + size_t(std::lround(std::min(1.0, before / sum) * parts)), uint16_t(b));
    }
    parts_.resize(begin + parts, uint16_t(shares.size() - 1));
}

void SkyGuide::fill_slots() {
    size_t size = 1;
    while (size < 2 * keys_.size() + 1) size *= 2;
    slots_.resize(size);
    for (size_t i = 0; i < keys_.size(); ++i) {
        size_t at = mix_bits(keys_[i]) & (size - 1);
        while (slots_[at].key) at = (at + 1) & (size - 1);
        slots_[at] = {keys_[i], uint32_t(i)};
    }
}

std::span<const uint16_t> SkyGuide::find(const Receiver& receiver) const {
    const uint64_t place = place_of(receiver);
    for (int level = 0; level < levels; ++level) {
        const uint64_t key = key_at(place, level);
        for (size_t at = mix_bits(key) & (slots_.size() - 1); slots_[at].key; at = (at + 1) & (slots_.size() - 1))
            if (slots_[at].key == key) return {&parts_[size_t(slots_[at].cell) * parts], size_t(parts)};
    }
    return {};
}

float SkyGuide::gain(int block, int parts_of_block) const {
    return unguided + (1 - unguided) / parts * float(parts_of_block) * per_probability_[size_t(block)];
}

EnvironmentSample SkyGuide::estimate(const Receiver& receiver, Vec2 u, Counters& counters) const {
    const std::span<const uint16_t> cell = find(receiver);
    if (cell.empty()) return environment_->estimate_sky(u);
    counters.count(Feature::guided_sky);
    if (u.x < unguided) {
        EnvironmentSample s = environment_->estimate_sky({u.x / unguided, u.y});
        s.pdf = density(cell, s);
        return s;
    }
    const float position = std::min((u.x - unguided) / (1 - unguided), 0x1.fffffep-1f) * parts;
    int begin = int(position), end = begin + 1;
    const uint16_t block = cell[size_t(begin)];
    while (begin > 0 && cell[size_t(begin) - 1] == block) --begin;
    while (end < parts && cell[size_t(end)] == block) ++end;
    const float rest = std::min((position - float(begin)) / float(end - begin), 0x1.fffffep-1f);
    EnvironmentSample s = environment_->estimate_sky_in(environment_->block(lit_blocks_[block]), {rest, u.y});
    s.pdf *= gain(block, end - begin);
    return s;
}

float SkyGuide::density(std::span<const uint16_t> cell, const EnvironmentSample& sky) const {
    const int block = index_of_block_[size_t(sky.block)];
    const auto [first, end] = std::equal_range(cell.begin(), cell.end(), uint16_t(block));
    return sky.pdf * gain(block, int(end - first));
}

float SkyGuide::pdf(const Receiver& receiver, const EnvironmentSample& sky) const {
    const std::span<const uint16_t> cell = find(receiver);
    return cell.empty() ? sky.pdf : density(cell, sky);
}

}  // namespace pluvia
