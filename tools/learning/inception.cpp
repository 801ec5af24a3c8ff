#include "tools/learning/inception.h"

namespace pluvia {
namespace {

constexpr int64_t input_side = 299;

at::Tensor halved(const at::Tensor& x) {
    return at::max_pool2d(x, {3, 3}, {2, 2});
}

/// Mean of the neighbours that lie within the picture.
at::Tensor neighbours(const at::Tensor& x) {
    return at::avg_pool2d(x, {3, 3}, {1, 1}, {1, 1}, false, false);
}

}  // namespace

at::Tensor Inception::conv(const std::string& name, const at::Tensor& x, int64_t out, Kernel k, int64_t stride,
                           bool padded) {
    auto found = parts_.find(name);
    if (found == parts_.end()) {
        const Parameters p = parameters_.part(name), norm = p.part("bn");
        const int64_t in = x.size(1);
        found = parts_
                    .emplace(name, Part{p.part("conv").get("weight", {out, in, k.height, k.width},
                                                           {Start::uniform, in * k.height * k.width}),
                                        norm.get("weight", {out}, {Start::one}), norm.get("bias", {out}, {Start::zero}),
                                        norm.get("running_mean", {out}, {Start::zero}),
                                        norm.get("running_var", {out}, {Start::one})})
                    .first;
    }
    const Part& part = found->second;
    const int64_t rows = padded ? k.height / 2 : 0, columns = padded ? k.width / 2 : 0;
    const at::Tensor h =
        at::conv2d(x, part.weight, {}, at::IntArrayRef{stride, stride}, at::IntArrayRef{rows, columns});
    return at::relu(
        at::batch_norm(h, part.norm_weight, part.norm_bias, part.mean, part.variance, false, 0, 1e-3, false));
}

at::Tensor Inception::block_a(const std::string& name, const at::Tensor& x, int64_t pooled) {
    const at::Tensor five = conv(name + ".branch5x5_2", conv(name + ".branch5x5_1", x, 48, 1), 64, 5);
    at::Tensor three = conv(name + ".branch3x3dbl_1", x, 64, 1);
    three = conv(name + ".branch3x3dbl_2", three, 96, 3);
    three = conv(name + ".branch3x3dbl_3", three, 96, 3);
    return at::cat(
        {conv(name + ".branch1x1", x, 64, 1), five, three, conv(name + ".branch_pool", neighbours(x), pooled, 1)}, 1);
}

at::Tensor Inception::block_b(const std::string& name, const at::Tensor& x) {
    at::Tensor three = conv(name + ".branch3x3dbl_1", x, 64, 1);
    three = conv(name + ".branch3x3dbl_2", three, 96, 3);
    three = conv(name + ".branch3x3dbl_3", three, 96, 3, 2, false);
    return at::cat({conv(name + ".branch3x3", x, 384, 3, 2, false), three, halved(x)}, 1);
}

at::Tensor Inception::block_c(const std::string& name, const at::Tensor& x, int64_t width) {
    constexpr Kernel row{1, 7}, column{7, 1};
    at::Tensor seven = conv(name + ".branch7x7_1", x, width, 1);
    seven = conv(name + ".branch7x7_2", seven, width, row);
    seven = conv(name + ".branch7x7_3", seven, 192, column);
    at::Tensor twice = conv(name + ".branch7x7dbl_1", x, width, 1);
    twice = conv(name + ".branch7x7dbl_2", twice, width, column);
    twice = conv(name + ".branch7x7dbl_3", twice, width, row);
    twice = conv(name + ".branch7x7dbl_4", twice, width, column);
    twice = conv(name + ".branch7x7dbl_5", twice, 192, row);
    return at::cat(
        {conv(name + ".branch1x1", x, 192, 1), seven, twice, conv(name + ".branch_pool", neighbours(x), 192, 1)}, 1);
}

at::Tensor Inception::block_d(const std::string& name, const at::Tensor& x) {
    const at::Tensor three = conv(name + ".branch3x3_2", conv(name + ".branch3x3_1", x, 192, 1), 320, 3, 2, false);
    at::Tensor seven = conv(name + ".branch7x7x3_1", x, 192, 1);
    seven = conv(name + ".branch7x7x3_2", seven, 192, Kernel{1, 7});
    seven = conv(name + ".branch7x7x3_3", seven, 192, Kernel{7, 1});
    seven = conv(name + ".branch7x7x3_4", seven, 192, 3, 2, false);
    return at::cat({three, seven, halved(x)}, 1);
}

at::Tensor Inception::block_e(const std::string& name, const at::Tensor& x, bool largest) {
    constexpr Kernel row{1, 3}, column{3, 1};
    const at::Tensor three = conv(name + ".branch3x3_1", x, 384, 1);
    const at::Tensor twice = conv(name + ".branch3x3dbl_2", conv(name + ".branch3x3dbl_1", x, 448, 1), 384, 3);
    // The last block takes the largest neighbour where the one before takes the mean, as TensorFlow's did.
    const at::Tensor pooled = largest ? at::max_pool2d(x, {3, 3}, {1, 1}, {1, 1}) : neighbours(x);
    return at::cat({conv(name + ".branch1x1", x, 320, 1), conv(name + ".branch3x3_2a", three, 384, row),
                    conv(name + ".branch3x3_2b", three, 384, column), conv(name + ".branch3x3dbl_3a", twice, 384, row),
                    conv(name + ".branch3x3dbl_3b", twice, 384, column), conv(name + ".branch_pool", pooled, 192, 1)},
                   1);
}

at::Tensor Inception::operator()(const at::Tensor& picture) {
    at::Tensor h = at::upsample_bilinear2d(picture, {input_side, input_side}, false) * 2 - 1;
    h = conv("Conv2d_1a_3x3", h, 32, 3, 2, false);
    h = conv("Conv2d_2a_3x3", h, 32, 3, 1, false);
    h = halved(conv("Conv2d_2b_3x3", h, 64, 3));
    h = conv("Conv2d_3b_1x1", h, 80, 1);
    h = halved(conv("Conv2d_4a_3x3", h, 192, 3, 1, false));
    h = block_a("Mixed_5b", h, 32);
    h = block_a("Mixed_5c", h, 64);
    h = block_a("Mixed_5d", h, 64);
    h = block_b("Mixed_6a", h);
    h = block_c("Mixed_6b", h, 128);
    h = block_c("Mixed_6c", h, 160);
    h = block_c("Mixed_6d", h, 160);
    h = block_c("Mixed_6e", h, 192);
    h = block_d("Mixed_7a", h);
    h = block_e("Mixed_7b", h, false);
    h = block_e("Mixed_7c", h, true);
    return h.mean({2, 3}).flatten();
}

}  // namespace pluvia
