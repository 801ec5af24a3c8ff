// The network whose features FID compares: Inception-v3 as TensorFlow published it on 2015-12-05, in the version of
// pytorch-fid, whose keys it has. Source: Szegedy et al. 2016, Heusel et al. 2017.
#pragma once

#include "tools/learning/layers.h"

#include <map>
#include <string>

namespace pluvia {

constexpr int64_t inception_features = 2048;

/// Tensors are asked for when the first picture passes.
class Inception {
public:
    explicit Inception(Parameters p) : parameters_(std::move(p)) {}

    /// picture: [1, 3, height, width] in 0..1, brought to 299 x 299 by bilinear interpolation. Returns [2048].
    at::Tensor operator()(const at::Tensor& picture);

private:
    /// A convolution, batch normalisation with stored statistics, and what is above zero of that.
    struct Part {
        at::Tensor weight, norm_weight, norm_bias, mean, variance;
    };
    struct Kernel {
        int64_t height, width;
    };
    at::Tensor conv(const std::string& name, const at::Tensor& x, int64_t out, Kernel kernel, int64_t stride = 1,
                    bool padded = true);
    at::Tensor conv(const std::string& name, const at::Tensor& x, int64_t out, int64_t size, int64_t stride = 1,
                    bool padded = true) {
        return conv(name, x, out, Kernel{size, size}, stride, padded);
    }
    at::Tensor block_a(const std::string& name, const at::Tensor& x, int64_t pooled);
    at::Tensor block_b(const std::string& name, const at::Tensor& x);
    at::Tensor block_c(const std::string& name, const at::Tensor& x, int64_t width);
    at::Tensor block_d(const std::string& name, const at::Tensor& x);
    at::Tensor block_e(const std::string& name, const at::Tensor& x, bool largest);

    Parameters parameters_;
    std::map<std::string, Part> parts_;
};

}  // namespace pluvia
