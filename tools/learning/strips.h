// Convolutions of large pictures, made a strip of rows at a time: the normed, enlarged or reordered copies that a
// convolution needs are then no larger than a strip. Only for inference; with gradients all is made at once.
#pragma once

#include "tools/learning/layers.h"

namespace pluvia {

/// Values of a strip's input, 16 MiB; pictures of no more are made at once.
constexpr int64_t strip_values = 4 << 20;

// x: [batch, channels, height, width]; convolutions keep the size. Answers differ from those made at once by rounding.

at::Tensor convolve(const Convolution& conv, const at::Tensor& x, int64_t values = strip_values);
/// conv(swish(norm(x))).
at::Tensor convolve_normed(const GroupNorm& norm, const Convolution& conv, const at::Tensor& x,
                           int64_t values = strip_values);
/// conv(double_size(x)).
at::Tensor convolve_doubled(const Convolution& conv, const at::Tensor& x, int64_t values = strip_values);

}  // namespace pluvia
