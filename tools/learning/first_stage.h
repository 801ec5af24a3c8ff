// The first stage: pictures to a latent of a sixteenth of the cells and back, with a codebook before decoding.
// Keys as in latent diffusion's vq-f4. Source: Esser et al. 2021 (VQGAN), Rombach et al. 2022.
#pragma once

#include "tools/learning/attention.h"

#include <optional>
#include <vector>

namespace pluvia {

class FirstStage {
public:
    FirstStage(const Parameters& p, const FirstStageConfig& config);

    /// picture: [batch, 3, height, width] in -1..1, sides multiples of config.factor(). Returns the latent before the
    /// codebook, [batch, code_channels, height / factor, width / factor].
    at::Tensor encode(const at::Tensor& picture) const;
    /// Each cell becomes the nearest code, then a picture, about -1..1 and not clipped.
    at::Tensor decode(const at::Tensor& latent) const;
    /// The nearest code of each cell by squared distance, same shape.
    at::Tensor quantize(const at::Tensor& latent) const;

    const FirstStageConfig& config() const { return config_; }

private:
    struct Residual {
        GroupNorm norm1, norm2;
        Convolution conv1, conv2;
        std::optional<Convolution> shortcut;

        Residual(const Parameters& p, int64_t in, int64_t out);
        at::Tensor operator()(const at::Tensor& x) const;
    };
    struct Middle {
        Residual block_1, block_2;
        CellAttention attention;

        Middle(const Parameters& p, int64_t channels);
        at::Tensor operator()(const at::Tensor& x) const;
    };
    struct Level {
        std::vector<Residual> blocks;
        std::optional<Convolution> resize;
    };
    /// Encoder or decoder: where it begins and ends, and its levels in the order of use.
    struct Half {
        Convolution conv_in;
        std::vector<Level> levels;
        Middle middle;
        GroupNorm norm_out;
        Convolution conv_out;
    };
    static Half make_encoder(const Parameters& p, const FirstStageConfig& config);
    static Half make_decoder(const Parameters& p, const FirstStageConfig& config);

    FirstStageConfig config_;
    Half encoder_, decoder_;
    Convolution before_codes_, after_codes_;
    at::Tensor codes_;
};

}  // namespace pluvia
