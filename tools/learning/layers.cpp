#include "tools/learning/layers.h"

#include <numeric>

namespace pluvia {

Convolution::Convolution(const Parameters& p, int64_t in, int64_t out, int64_t size, int64_t stride_, int64_t padding_,
                         bool last_layer)
    : weight(p.get("weight", {out, in, size, size}, {Start::uniform, in * size * size, last_layer})),
      bias(p.get("bias", {out}, {Start::uniform, in * size * size, last_layer})),
      stride(stride_),
      padding(padding_) {}

at::Tensor Convolution::operator()(const at::Tensor& x) const {
    return at::conv2d(x, weight, bias, stride, padding);
}

Linear::Linear(const Parameters& p, int64_t in, int64_t out, bool with_bias)
    : weight(p.get("weight", {out, in}, {Start::uniform, in})) {
    if (with_bias) bias = p.get("bias", {out}, {Start::uniform, in});
}

at::Tensor Linear::operator()(const at::Tensor& x) const {
    return bias.defined() ? at::linear(x, weight, bias) : at::linear(x, weight);
}

GroupNorm::GroupNorm(const Parameters& p, int64_t channels, double epsilon_)
    : weight(p.get("weight", {channels}, {Start::one})),
      bias(p.get("bias", {channels}, {Start::zero})),
      epsilon(epsilon_) {}

int64_t GroupNorm::groups() const {
    return std::gcd(int64_t(32), weight.size(0));
}

at::Tensor GroupNorm::operator()(const at::Tensor& x) const {
    return at::group_norm(x, groups(), weight, bias, epsilon);
}

at::Tensor swish(at::Tensor x) {
    return c10::GradMode::is_enabled() ? at::silu(x) : at::silu_(x);
}

at::Tensor double_size(const at::Tensor& x) {
    return at::upsample_nearest2d(x, {2 * x.size(2), 2 * x.size(3)});
}

}  // namespace pluvia
