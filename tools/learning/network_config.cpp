#include "tools/learning/network_config.h"

#include "renderer/core/error.h"

#include <fmt/format.h>

#include <algorithm>

namespace pluvia {
namespace {

constexpr int64_t max_channels = 8192, max_blocks = 64, max_levels = 8;

const TensorShape& shape_of(const TensorShapes& shapes, const std::string& name, size_t rank,
                            const std::string& where) {
    const auto found = shapes.find(name);
    if (found == shapes.end()) throw input_error(where, fmt::format("has no tensor \"{}\"", name));
    if (found->second.size() != rank)
        throw input_error(where, fmt::format("tensor \"{}\" has the wrong number of dimensions (got {}, expected {})",
                                             name, shape_text(found->second), rank));
    for (const int64_t side : found->second)
        if (side < 1 || side > max_channels * 16)
            throw input_error(
                where, fmt::format("tensor \"{}\" has a side out of range (got {})", name, shape_text(found->second)));
    return found->second;
}

int64_t multiple_of(int64_t value, int64_t unit, const std::string& where) {
    if (value % unit != 0 || value > max_channels)
        throw input_error(where,
                          fmt::format("has a width that is no multiple of the first (got {} and {})", value, unit));
    return value / unit;
}

/// How many blocks a level has.
int64_t count_blocks(const TensorShapes& shapes, const std::string& level) {
    int64_t n = 0;
    while (n < max_blocks && shapes.count(fmt::format("{}.block.{}.conv1.weight", level, n)) != 0) ++n;
    return n;
}

}  // namespace

TensorShapes shapes_below(const std::map<std::string, TensorEntry>& entries, const std::string& prefix) {
    TensorShapes shapes;
    for (auto it = entries.lower_bound(prefix); it != entries.end() && it->first.starts_with(prefix); ++it)
        shapes[it->first.substr(prefix.size())] = it->second.shape;
    return shapes;
}

FirstStageConfig first_stage_config(const TensorShapes& shapes, const std::string& where) {
    FirstStageConfig c;
    const TensorShape& conv_in = shape_of(shapes, "encoder.conv_in.weight", 4, where);
    c.channels = conv_in[0];
    c.image_channels = conv_in[1];
    c.latent_channels = shape_of(shapes, "encoder.conv_out.weight", 4, where)[0];
    const TensorShape& codes = shape_of(shapes, "quantize.embedding.weight", 2, where);
    c.codes = codes[0];
    c.code_channels = codes[1];
    c.multipliers.clear();
    for (int64_t level = 0; level < max_levels; ++level) {
        const std::string name = fmt::format("encoder.down.{}.block.0.conv1.weight", level);
        if (shapes.count(name) == 0) break;
        c.multipliers.push_back(multiple_of(shape_of(shapes, name, 4, where)[0], c.channels, where));
    }
    if (c.multipliers.empty()) throw input_error(where, "has a first stage without levels");
    c.res_blocks = count_blocks(shapes, "encoder.down.0");
    return c;
}

UNetConfig unet_config(const TensorShapes& shapes, int64_t head_width, const std::string& where) {
    UNetConfig c;
    c.head_width = head_width;
    const TensorShape& first = shape_of(shapes, "input_blocks.0.0.weight", 4, where);
    c.channels = first[0];
    c.in_channels = first[1];
    c.out_channels = shape_of(shapes, "out.2.weight", 4, where)[0];
    c.multipliers.clear();
    c.attention_factors.clear();
    int64_t factor = 1, blocks = 0;
    for (int64_t n = 1; n < max_blocks; ++n) {
        const std::string block = fmt::format("input_blocks.{}", n);
        if (shapes.count(block + ".0.op.weight") != 0) {
            factor *= 2;
            blocks = 0;
            continue;
        }
        if (shapes.count(block + ".0.in_layers.2.weight") == 0) break;
        const int64_t width = shape_of(shapes, block + ".0.in_layers.2.weight", 4, where)[0];
        if (blocks++ == 0) c.multipliers.push_back(multiple_of(width, c.channels, where));
        const bool attention = shapes.count(block + ".1.norm.weight") != 0;
        if (attention && (c.attention_factors.empty() || c.attention_factors.back() != factor))
            c.attention_factors.push_back(factor);
        const std::string key = block + ".1.transformer_blocks.0.attn2.to_k.weight";
        if (shapes.count(key) != 0) c.context_channels = shape_of(shapes, key, 2, where)[1];
    }
    c.res_blocks = blocks;
    if (blocks == 0 || c.multipliers.size() > size_t(max_levels)) throw input_error(where, "has no valid UNet levels");
    if (factor != c.factor()) throw input_error(where, "has a UNet with a level that holds nothing");
    for (const int64_t f : c.attention_factors)
        for (size_t level = 0; level < c.multipliers.size(); ++level)
            if (f == int64_t(1) << level && (c.channels * c.multipliers[level]) % c.head_width != 0)
                throw input_error(where, fmt::format("has attention of {} channels, no multiple of the head width {}",
                                                     c.channels * c.multipliers[level], c.head_width));
    return c;
}

}  // namespace pluvia
