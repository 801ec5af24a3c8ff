// Convolutions made in strips against the same made at once.
#include "tools/learning/strips.h"

#include <doctest/doctest.h>

using namespace pluvia;

namespace {

double largest_difference(const at::Tensor& a, const at::Tensor& b) {
    REQUIRE(a.sizes() == b.sizes());
    return (a - b).abs().max().item<double>();
}

constexpr double tolerance = 1e-5;  // float sums of 288 products of order one, in another order

}  // namespace

TEST_CASE("a convolution in strips answers as one made at once, whatever the size of the strips") {
    const c10::NoGradGuard no_gradients;
    const Parameters p = fresh_parameters(5, true);
    const Convolution wide(p.part("wide"), 32, 16, 3, 1, 1), narrow(p.part("narrow"), 32, 8, 1);
    const GroupNorm norm(p.part("norm"), 32, 1e-6);
    // Rows that are no multiple of a strip's, and a mean that is not zero.
    const at::Tensor x = p.get("x", {2, 32, 37, 24}, {Start::uniform}) * 3 + 0.5;
    for (const int64_t values : {int64_t(1), int64_t(20'000)}) {
        CAPTURE(values);
        CHECK(largest_difference(convolve(wide, x, values), wide(x)) < tolerance);
        CHECK(largest_difference(convolve(narrow, x, values), narrow(x)) < tolerance);
        CHECK(largest_difference(convolve_normed(norm, wide, x, values), wide(swish(norm(x)))) < tolerance);
        CHECK(largest_difference(convolve_doubled(wide, x, values), wide(double_size(x))) < tolerance);
    }
}

TEST_CASE("gradients flow where strips would break them") {
    const Parameters p = fresh_parameters(5, true);
    const Convolution wide(p.part("wide"), 32, 16, 3, 1, 1);
    at::Tensor x = p.get("x", {1, 32, 20, 24}, {Start::uniform});
    x.set_requires_grad(true);
    convolve(wide, x, 1).sum().backward();
    CHECK(x.grad().abs().max().item<double>() > 0);
}
