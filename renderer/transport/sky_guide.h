// Which parts of the sky light a place: learned by a few paths before the picture, used to draw light samples of the
// sky where it can be seen. In streets most of it is hidden from most places, and samples of it would be in vain.
// Unbiased: every direction that shines keeps a probability.
#pragma once

#include "renderer/core/counters.h"
#include "renderer/scene/light_tree.h"
#include "shaders/environment.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace pluvia {

/// A direction from which a surface takes light and in which nothing is before the sky.
struct SkySight {
    Receiver receiver;
    int block;  // of the environment's picture
};

/// For each cell of space and each side that surfaces in it face, a distribution over the blocks of the sky. Cells that
/// few paths have met lean on larger ones around them, from 0.5 m to 32 m.
class SkyGuide {
public:
    /// sights: each drawn with a density in proportion to what its surface scatters on from there; in any order. Keeps
    /// a reference to the environment, which has_blocks().
    SkyGuide(const Environment& environment, const std::vector<SkySight>& sights);

    /// As Environment::estimate_sky, but guided, where something is known of the receiver's place.
    EnvironmentSample estimate(const Receiver& receiver, Vec2 u, Counters& counters) const;
    /// Density of estimate() in a direction, for what Environment::sky is there.
    float pdf(const Receiver& receiver, const EnvironmentSample& sky) const;

private:
    using Shares = std::vector<float>;  // of the lit blocks
    /// Parts of equal probability that a cell's distribution is rounded to. What is less likely than half of one is
    /// left to the samples that nothing guides.
    static constexpr int parts = 512;
    struct Sight {
        uint64_t place;  // key of the smallest cell
        int block;       // index among the lit ones
    };
    struct Slot {
        uint64_t key = 0;  // 0: empty
        uint32_t cell = 0;
    };

    void find_blocks();
    /// The cells of a level that these sights fall into, and those within them. larger: what is known of all of them.
    void learn_cells(std::span<const Sight> sights, int level, const Shares& larger);
    Shares shares_of(std::span<const Sight> sights, const Shares& larger) const;
    void add_cell(const Shares& shares);
    void fill_slots();
    /// For each part the lit block that it belongs to, in rising order. Empty where nothing is known.
    std::span<const uint16_t> find(const Receiver& receiver) const;
    float density(std::span<const uint16_t> cell, const EnvironmentSample& sky) const;
    /// Factor on the density of a sample that knows nothing, in a lit block that so many parts belong to.
    float gain(int block, int parts_of_block) const;

    const Environment* environment_;
    std::vector<int> lit_blocks_;           // those that shine
    std::vector<int> index_of_block_;       // among them; 0 for others
    std::vector<std::array<int, 9>> near_;  // of a lit block: itself and those around it, itself where they are dark
    std::vector<double> radiance_;          // of lit blocks: the mean, relative
    std::vector<float> per_probability_;    // of lit blocks: 1 / probability
    std::vector<uint16_t> parts_;           // of all cells
    std::vector<uint64_t> keys_;            // of all cells
    std::vector<Slot> slots_;               // open addressing
};

}  // namespace pluvia
