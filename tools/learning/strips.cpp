#include "tools/learning/strips.h"

#include <algorithm>
#include <functional>

namespace pluvia {
namespace {

/// Rows first to first + count - 1 of a convolution's input.
using Rows = std::function<at::Tensor(int64_t first, int64_t count)>;

/// channels, height, width: of the input.
at::Tensor in_strips(const Convolution& conv, const at::Tensor& like, int64_t channels, int64_t height, int64_t width,
                     int64_t values, const Rows& rows) {
    const int64_t batch = like.size(0), edge = conv.padding;
    at::Tensor result = at::empty({batch, conv.weight.size(0), height, width}, like.options());
    const int64_t step = std::max<int64_t>(8, values / (batch * channels * width));
    for (int64_t first = 0; first < height; first += step) {
        const int64_t count = std::min(step, height - first);
        const int64_t from = std::max<int64_t>(0, first - edge), to = std::min(height, first + count + edge);
        const at::Tensor part =
            at::constant_pad_nd(rows(from, to - from), {edge, edge, from - (first - edge), first + count + edge - to});
        result.narrow(2, first, count).copy_(at::conv2d(part, conv.weight, conv.bias));
    }
    return result;
}

bool at_once(const at::Tensor& x, int64_t scale, int64_t values) {
    return c10::GradMode::is_enabled() || x.numel() * scale <= values;
}

/// Factor and offset of each channel, [batch, channels, 1, 1], that do what a norm does.
std::pair<at::Tensor, at::Tensor> scale_and_shift(const GroupNorm& norm, const at::Tensor& x) {
    const int64_t groups = norm.groups(), batch = x.size(0), channels = x.size(1);
    const auto [variance, mean] = at::var_mean(x.reshape({batch, groups, -1}), 2, false);
    const auto of_channels = [&](const at::Tensor& t) {
        return t.reshape({batch, groups, 1})
            .expand({batch, groups, channels / groups})
            .reshape({batch, channels, 1, 1});
    };
    const at::Tensor scale = of_channels(at::rsqrt(variance + norm.epsilon)) * norm.weight.reshape({1, channels, 1, 1});
    return {scale, norm.bias.reshape({1, channels, 1, 1}) - of_channels(mean) * scale};
}

}  // namespace

at::Tensor convolve(const Convolution& conv, const at::Tensor& x, int64_t values) {
    if (at_once(x, 1, values)) return conv(x);
    return in_strips(conv, x, x.size(1), x.size(2), x.size(3), values,
                     [&](int64_t first, int64_t count) { return x.narrow(2, first, count); });
}

at::Tensor convolve_normed(const GroupNorm& norm, const Convolution& conv, const at::Tensor& x, int64_t values) {
    if (at_once(x, 1, values)) return conv(swish(norm(x)));
    const auto [scale, shift] = scale_and_shift(norm, x);
    return in_strips(conv, x, x.size(1), x.size(2), x.size(3), values,
                     [&, &scale = scale, &shift = shift](int64_t first, int64_t count) {
                         return swish(x.narrow(2, first, count).mul(scale).add_(shift));
                     });
}

at::Tensor convolve_doubled(const Convolution& conv, const at::Tensor& x, int64_t values) {
    if (at_once(x, 4, values)) return conv(double_size(x));
    return in_strips(conv, x, x.size(1), 2 * x.size(2), 2 * x.size(3), values, [&](int64_t first, int64_t count) {
        const int64_t from = first / 2, to = (first + count + 1) / 2;
        return double_size(x.narrow(2, from, to - from)).narrow(2, first - 2 * from, count);
    });
}

}  // namespace pluvia
