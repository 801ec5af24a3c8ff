// The layers that all networks here are made of. Pictures are [batch, channels, height, width].
// Attention is in attention.h.
#pragma once

#include "tools/learning/parameters.h"

namespace pluvia {

struct Convolution {
    at::Tensor weight, bias;
    int64_t stride = 1, padding = 0;

    /// Sides of the kernel are size; padding with zeros.
    Convolution(const Parameters& p, int64_t in, int64_t out, int64_t size, int64_t stride = 1, int64_t padding = 0,
                bool last_layer = false);
    at::Tensor operator()(const at::Tensor& x) const;
};

struct Linear {
    at::Tensor weight, bias;  // bias may be undefined

    Linear(const Parameters& p, int64_t in, int64_t out, bool with_bias = true);
    at::Tensor operator()(const at::Tensor& x) const;
};

/// Group normalisation in 32 groups, or in as many as divide both 32 and the channels. Source: Wu and He 2018.
struct GroupNorm {
    at::Tensor weight, bias;
    double epsilon;

    GroupNorm(const Parameters& p, int64_t channels, double epsilon);
    int64_t groups() const;
    at::Tensor operator()(const at::Tensor& x) const;
};

/// x sigmoid(x), the activation of all networks here; overwrites x where nobody needs it for gradients.
at::Tensor swish(at::Tensor x);

/// Twice the size, each value repeated.
at::Tensor double_size(const at::Tensor& x);

}  // namespace pluvia
