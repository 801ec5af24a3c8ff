// The noise predictor: a UNet with the time of the diffusion added to each block, and attention at coarse levels.
// Keys as in guided and latent diffusion. Source: Dhariwal and Nichol 2021, Rombach et al. 2022.
#pragma once

#include "tools/learning/attention.h"

#include <variant>
#include <vector>

namespace pluvia {

class UNet {
public:
    UNet(const Parameters& p, const UNetConfig& config);

    /// x: [batch, in_channels, height, width], sides multiples of config.factor(). time: [batch], 0 to 999.
    /// context: [batch, tokens, context_channels], or undefined where the network has no attention to a guide.
    at::Tensor operator()(const at::Tensor& x, const at::Tensor& time, const at::Tensor& context = {}) const;

    const UNetConfig& config() const { return config_; }

private:
    struct Residual {
        GroupNorm norm_in, norm_out;
        Convolution conv_in, conv_out;
        Linear time;
        std::optional<Convolution> skip;

        Residual(const Parameters& p, int64_t in, int64_t out, int64_t time_channels);
        at::Tensor operator()(const at::Tensor& x, const at::Tensor& time_embedding) const;
    };
    struct Up {
        Convolution conv;
    };
    using Part = std::variant<Convolution, Residual, HeadAttention, GuidedAttention, Up>;
    using Block = std::vector<Part>;

    struct Builder;
    static at::Tensor apply(const Block& block, at::Tensor x, const at::Tensor& time_embedding,
                            const at::Tensor& context);

    UNetConfig config_;
    Linear time0_, time2_;
    std::vector<Block> down_, up_;
    Block middle_;
    std::optional<GroupNorm> out_norm_;
    std::optional<Convolution> out_conv_;
};

/// Cosines, then sines of time at frequencies from 1 to 1/10000. time: [batch]; returns [batch, channels].
at::Tensor time_waves(const at::Tensor& time, int64_t channels);

}  // namespace pluvia
