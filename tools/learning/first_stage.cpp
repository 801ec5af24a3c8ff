#include "tools/learning/first_stage.h"

#include "tools/learning/strips.h"

#include <algorithm>

namespace pluvia {
namespace {

constexpr double norm_epsilon = 1e-6;
constexpr int64_t cells_at_a_time = 1024;  // 1024 x 8192 distances are 32 MiB

}  // namespace

FirstStage::Residual::Residual(const Parameters& p, int64_t in, int64_t out)
    : norm1(p.part("norm1"), in, norm_epsilon),
      norm2(p.part("norm2"), out, norm_epsilon),
      conv1(p.part("conv1"), in, out, 3, 1, 1),
      conv2(p.part("conv2"), out, out, 3, 1, 1) {
    if (in != out) shortcut.emplace(p.part("nin_shortcut"), in, out, 1);
}

at::Tensor FirstStage::Residual::operator()(const at::Tensor& x) const {
    at::Tensor h = convolve_normed(norm1, conv1, x);
    h = convolve_normed(norm2, conv2, h);  // what went in is let go
    if (c10::GradMode::is_enabled()) return (shortcut ? (*shortcut)(x) : x) + h;
    return h.add_(shortcut ? convolve(*shortcut, x) : x);
}

FirstStage::Middle::Middle(const Parameters& p, int64_t channels)
    : block_1(p.part("block_1"), channels, channels),
      block_2(p.part("block_2"), channels, channels),
      attention(p.part("attn_1"), channels) {}

at::Tensor FirstStage::Middle::operator()(const at::Tensor& x) const {
    return block_2(attention(block_1(x)));
}

FirstStage::Half FirstStage::make_encoder(const Parameters& p, const FirstStageConfig& c) {
    std::vector<Level> levels;
    int64_t width = c.channels;
    for (size_t i = 0; i < c.multipliers.size(); ++i) {
        const Parameters here = p.part("down").part(int64_t(i));
        Level level;
        for (int64_t block = 0; block < c.res_blocks; ++block) {
            level.blocks.emplace_back(here.part("block").part(block), width, c.channels * c.multipliers[i]);
            width = c.channels * c.multipliers[i];
        }
        if (i + 1 < c.multipliers.size()) level.resize.emplace(here.part("downsample.conv"), width, width, 3, 2);
        levels.push_back(std::move(level));
    }
    return {Convolution(p.part("conv_in"), c.image_channels, c.channels, 3, 1, 1), std::move(levels),
            Middle(p.part("mid"), width), GroupNorm(p.part("norm_out"), width, norm_epsilon),
            Convolution(p.part("conv_out"), width, c.latent_channels, 3, 1, 1)};
}

FirstStage::Half FirstStage::make_decoder(const Parameters& p, const FirstStageConfig& c) {
    std::vector<Level> levels;
    const int64_t top = c.channels * c.multipliers.back();
    int64_t width = top;
    for (size_t i = c.multipliers.size(); i-- > 0;) {
        const Parameters here = p.part("up").part(int64_t(i));
        Level level;
        for (int64_t block = 0; block <= c.res_blocks; ++block) {
            level.blocks.emplace_back(here.part("block").part(block), width, c.channels * c.multipliers[i]);
            width = c.channels * c.multipliers[i];
        }
        if (i > 0) level.resize.emplace(here.part("upsample.conv"), width, width, 3, 1, 1);
        levels.push_back(std::move(level));
    }
    return {Convolution(p.part("conv_in"), c.latent_channels, top, 3, 1, 1), std::move(levels),
            Middle(p.part("mid"), top), GroupNorm(p.part("norm_out"), width, norm_epsilon),
            Convolution(p.part("conv_out"), width, c.image_channels, 3, 1, 1)};
}

FirstStage::FirstStage(const Parameters& p, const FirstStageConfig& config)
    : config_(config),
      encoder_(make_encoder(p.part("encoder"), config)),
      decoder_(make_decoder(p.part("decoder"), config)),
      before_codes_(p.part("quant_conv"), config.latent_channels, config.code_channels, 1),
      after_codes_(p.part("post_quant_conv"), config.code_channels, config.latent_channels, 1),
      codes_(p.part("quantize.embedding").get("weight", {config.codes, config.code_channels}, {Start::uniform})) {}

at::Tensor FirstStage::encode(const at::Tensor& picture) const {
    at::Tensor h = convolve(encoder_.conv_in, picture);
    for (const Level& level : encoder_.levels) {
        for (const Residual& block : level.blocks) h = block(h);
        // Padded on the right and below only, as the original is.
        if (level.resize) h = (*level.resize)(at::constant_pad_nd(h, {0, 1, 0, 1}));
    }
    h = encoder_.middle(h);
    return before_codes_(convolve_normed(encoder_.norm_out, encoder_.conv_out, h));
}

at::Tensor FirstStage::quantize(const at::Tensor& latent) const {
    const at::Tensor cells = latent.permute({0, 2, 3, 1}).reshape({-1, latent.size(1)});
    const at::Tensor code_lengths = codes_.square().sum(1);
    std::vector<at::Tensor> nearest;
    for (int64_t first = 0; first < cells.size(0); first += cells_at_a_time) {
        const at::Tensor some = cells.narrow(0, first, std::min(cells_at_a_time, cells.size(0) - first));
        // |z - e|^2 without |z|^2, which is the same for all codes.
        nearest.push_back(at::argmin(at::addmm(code_lengths, some, codes_.t(), 1, -2), 1));
    }
    return codes_.index_select(0, at::cat(nearest))
        .reshape({latent.size(0), latent.size(2), latent.size(3), latent.size(1)})
        .permute({0, 3, 1, 2})
        .contiguous();
}

at::Tensor FirstStage::decode(const at::Tensor& latent) const {
    at::Tensor h = decoder_.conv_in(after_codes_(quantize(latent)));
    h = decoder_.middle(h);
    for (const Level& level : decoder_.levels) {
        for (const Residual& block : level.blocks) h = block(h);
        if (level.resize) h = convolve_doubled(*level.resize, h);
    }
    return convolve_normed(decoder_.norm_out, decoder_.conv_out, h);
}

}  // namespace pluvia
