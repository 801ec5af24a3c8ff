#include "tools/learning/unet.h"

#include "renderer/core/error.h"

#include <algorithm>
#include <cmath>

namespace pluvia {

at::Tensor time_waves(const at::Tensor& time, int64_t channels) {
    const int64_t half = channels / 2;
    const at::Tensor frequencies =
        at::exp(at::arange(half, at::TensorOptions(at::kFloat).device(time.device())) * (-std::log(10000.0) / half));
    const at::Tensor angles = time.to(at::kFloat).unsqueeze(1) * frequencies.unsqueeze(0);
    return at::cat({at::cos(angles), at::sin(angles)}, 1);
}

UNet::Residual::Residual(const Parameters& p, int64_t in, int64_t out, int64_t time_channels)
    : norm_in(p.part("in_layers").part(0), in, 1e-5),
      norm_out(p.part("out_layers").part(0), out, 1e-5),
      conv_in(p.part("in_layers").part(2), in, out, 3, 1, 1),
      conv_out(p.part("out_layers").part(3), out, out, 3, 1, 1, true),
      time(p.part("emb_layers").part(1), time_channels, out) {
    if (in != out) skip.emplace(p.part("skip_connection"), in, out, 1);
}

at::Tensor UNet::Residual::operator()(const at::Tensor& x, const at::Tensor& time_embedding) const {
    at::Tensor h = conv_in(swish(norm_in(x)));
    h = h + time(at::silu(time_embedding)).unsqueeze(-1).unsqueeze(-1);
    h = conv_out(swish(norm_out(h)));
    return (skip ? (*skip)(x) : x) + h;
}

/// Puts parts into blocks and numbers them as the keys have it.
struct UNet::Builder {
    const UNetConfig& config;
    int64_t time_channels;

    Part attention(const Parameters& p, int64_t channels) const {
        if (config.context_channels > 0)
            return GuidedAttention(p, channels, config.head_width, config.context_channels);
        return HeadAttention(p, channels, config.head_width);
    }
    /// A residual block and, at this factor, attention.
    Block block(const Parameters& p, int64_t in, int64_t out, int64_t factor) const {
        Block parts;
        parts.emplace_back(Residual(p.part(0), in, out, time_channels));
        const auto& factors = config.attention_factors;
        if (std::find(factors.begin(), factors.end(), factor) != factors.end())
            parts.push_back(attention(p.part(1), out));
        return parts;
    }
};

UNet::UNet(const Parameters& p, const UNetConfig& config)
    : config_(config),
      time0_(p.part("time_embed").part(0), config.channels, 4 * config.channels),
      time2_(p.part("time_embed").part(2), 4 * config.channels, 4 * config.channels) {
    const Builder builder{config, 4 * config.channels};
    const int64_t levels = int64_t(config.multipliers.size());
    std::vector<int64_t> widths = {config.channels};  // of what the way down leaves for the way up
    down_.push_back({Convolution(p.part("input_blocks.0").part(0), config.in_channels, config.channels, 3, 1, 1)});
    int64_t width = config.channels;
    const auto next_down = [&] { return p.part("input_blocks").part(int64_t(down_.size())); };
    for (int64_t level = 0; level < levels; ++level) {
        for (int64_t i = 0; i < config.res_blocks; ++i) {
            const int64_t out = config.channels * config.multipliers[level];
            down_.push_back(builder.block(next_down(), width, out, int64_t(1) << level));
            widths.push_back(width = out);
        }
        if (level + 1 < levels) {
            down_.push_back({Convolution(next_down().part("0.op"), width, width, 3, 2, 1)});
            widths.push_back(width);
        }
    }
    const Parameters middle = p.part("middle_block");
    middle_.emplace_back(Residual(middle.part(0), width, width, builder.time_channels));
    middle_.push_back(builder.attention(middle.part(1), width));
    middle_.emplace_back(Residual(middle.part(2), width, width, builder.time_channels));
    for (int64_t level = levels - 1; level >= 0; --level)
        for (int64_t i = 0; i <= config.res_blocks; ++i) {
            const Parameters here = p.part("output_blocks").part(int64_t(up_.size()));
            const int64_t out = config.channels * config.multipliers[level];
            Block block = builder.block(here, width + widths.back(), out, int64_t(1) << level);
            widths.pop_back();
            width = out;
            if (level > 0 && i == config.res_blocks)
                block.emplace_back(
                    Up{Convolution(here.part(int64_t(block.size())).part("conv"), width, width, 3, 1, 1)});
            up_.push_back(std::move(block));
        }
    out_norm_.emplace(p.part("out").part(0), width, 1e-5);
    out_conv_.emplace(p.part("out").part(2), width, config.out_channels, 3, 1, 1, true);
}

at::Tensor UNet::apply(const Block& block, at::Tensor x, const at::Tensor& time_embedding, const at::Tensor& context) {
    for (const Part& part : block)
        x = std::visit(
            [&](const auto& layer) -> at::Tensor {
                using Layer = std::decay_t<decltype(layer)>;
                if constexpr (std::is_same_v<Layer, Residual>)
                    return layer(x, time_embedding);
                else if constexpr (std::is_same_v<Layer, GuidedAttention>)
                    return layer(x, context);
                else if constexpr (std::is_same_v<Layer, Up>)
                    return layer.conv(double_size(x));
                else
                    return layer(x);
            },
            part);
    return x;
}

at::Tensor UNet::operator()(const at::Tensor& x, const at::Tensor& time, const at::Tensor& context) const {
    const at::Tensor embedding = time2_(at::silu(time0_(time_waves(time, config_.channels))));
    std::vector<at::Tensor> kept;
    at::Tensor h = x;
    for (const Block& block : down_) kept.push_back(h = apply(block, h, embedding, context));
    h = apply(middle_, h, embedding, context);
    for (const Block& block : up_) {
        h = at::cat({h, kept.back()}, 1);
        kept.pop_back();
        h = apply(block, h, embedding, context);
    }
    return (*out_conv_)(swish((*out_norm_)(h)));
}

}  // namespace pluvia
