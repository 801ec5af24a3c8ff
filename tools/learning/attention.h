// Attention among the cells of a picture, and from them to the tokens of a guide.
// Scores are made for a block of queries at a time, so that memory grows with the cells and not with their square.
// Source: Vaswani et al. 2017; layouts as in Rombach et al. 2022.
#pragma once

#include "tools/learning/layers.h"

#include <optional>

namespace pluvia {

/// softmax(q^T k scale) applied to v. q [batch, width, queries]; k, v [batch, width, keys].
/// Returns [batch, width, queries].
at::Tensor attend(const at::Tensor& q, const at::Tensor& k, const at::Tensor& v, double scale);

/// Self-attention of the UNet: heads of one width, keys "qkv" and "proj_out" as 1-D convolutions, the three parts
/// within each head.
struct HeadAttention {
    GroupNorm norm;
    at::Tensor qkv_weight, qkv_bias, out_weight, out_bias;
    int64_t head_width;

    HeadAttention(const Parameters& p, int64_t channels, int64_t head_width);
    at::Tensor operator()(const at::Tensor& x) const;
};

/// Self-attention of the first stage: one head over all cells.
struct CellAttention {
    GroupNorm norm;
    Convolution q, k, v, out;

    CellAttention(const Parameters& p, int64_t channels);
    at::Tensor operator()(const at::Tensor& x) const;
};

/// A transformer block on the cells: self-attention, attention to a guide, gated layers.
/// Keys as latent diffusion's SpatialTransformer has them, one block deep.
class GuidedAttention {
public:
    GuidedAttention(const Parameters& p, int64_t channels, int64_t head_width, int64_t context_channels);
    /// context: [batch, tokens, context_channels].
    at::Tensor operator()(const at::Tensor& x, const at::Tensor& context) const;

private:
    struct Projections {
        Linear q, k, v, out;
        Projections(const Parameters& p, int64_t channels, int64_t context_channels);
    };
    struct LayerNorm {
        at::Tensor weight, bias;
        LayerNorm(const Parameters& p, int64_t channels);
        at::Tensor operator()(const at::Tensor& x) const;
    };
    at::Tensor attend_heads(const Projections& p, const at::Tensor& x, const at::Tensor& context) const;

    int64_t head_width_;
    GroupNorm norm_;
    Convolution in_;
    Projections self_, guide_;
    Linear gate_, back_;
    LayerNorm norm1_, norm2_, norm3_;
    Convolution out_;
};

}  // namespace pluvia
