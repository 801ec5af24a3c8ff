// Metrics against hand calculations and against scikit-image.
#include "renderer/core/random.h"
#include "tests/statistics.h"
#include "tests/temporary_folder.h"
#include "tools/validate/color_metrics.h"
#include "tools/validate/depth_metrics.h"
#include "tools/validate/metric_list.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace pluvia {
namespace {

Image<Rgb> noise(int width, int height, uint64_t seed, float low = 0, float high = 1) {
    Image<Rgb> image(width, height);
    for (size_t i = 0; i < image.pixels.size(); ++i) {
        const auto value = [&](uint64_t c) { return low + (high - low) * uniform(seed, i, c); };
        image.pixels[i] = {value(0), value(1), value(2)};
    }
    return image;
}

}  // namespace

TEST_CASE("errors of colours are those of a hand calculation") {
    Image<Rgb> a(2, 1), b(2, 1);
    a.pixels = {{1, 2, 3}, {0, 0, 0}};
    b.pixels = {{1, 1, 1}, {2, 0, 0}};
    CHECK(mean_squared_error(a, b) == doctest::Approx((0 + 1 + 4 + 4 + 0 + 0) / 6.0));
    const auto relative = relative_squared_errors(a, b);
    CHECK(relative[0] == doctest::Approx((1 / 1.01 + 4 / 1.01) / 3));
    CHECK(relative[1] == doctest::Approx(4 / 4.01 / 3));
    const Bias d = bias(a, b);
    CHECK(d.value == doctest::Approx((6.0 - 5.0) / 5.0));
    CHECK(d.channel[0] == doctest::Approx((1.0 - 3.0) / 3.0));
    // Differences of the pixels are 1 and -2/3: their mean is 1/6, their standard deviation 5/6 (of two), sqrt(2) more.
    CHECK(d.high - d.value == doctest::Approx(1.96 * (5.0 / 6) / (5.0 / 6)));
    CHECK(d.value - d.low == doctest::Approx(d.high - d.value));
    CHECK(psnr(a, b) == doctest::Approx(10 * std::log10(1 / (1.5 + 1e-8))));
    CHECK(psnr(a, a) == doctest::Approx(80));
}

TEST_CASE("the trimmed mean drops the worst thousandth and no more") {
    std::vector<double> values(3999, 1.0);
    for (int i = 0; i < 3; ++i) values[size_t(i) * 1000] = 1e6;
    CHECK(trimmed_mean(values) == 1);  // 3 of 3999
    values[3500] = 2;
    CHECK(trimmed_mean(values) == doctest::Approx(1 + 1.0 / 3996));
    CHECK(trimmed_mean(std::vector<double>{1, 3}) == 2);
}

TEST_CASE("the interval of a bias covers the truth as often as it says, and sees a bias of a thousandth") {
    int covered = 0;
    const int trials = 400;
    for (int t = 0; t < trials; ++t) {
        const Image<Rgb> a = noise(32, 32, 2 * uint64_t(t)), b = noise(32, 32, 2 * uint64_t(t) + 1);
        const Bias d = bias(a, b);
        covered += d.low <= 0 && d.high >= 0;
    }
    // 380 of 400 expected, binomial standard deviation 4.4.
    CAPTURE(covered);
    CHECK(std::abs(covered - 0.95 * trials) < 5 * std::sqrt(trials * 0.95 * 0.05));
    const Image<Rgb> a = noise(64, 64, 1);
    Image<Rgb> brighter = a;
    for (Rgb& p : brighter.pixels) p *= 1.001f;
    CHECK(bias(brighter, a).low > 0.0009);
    CHECK(bias(brighter, a).high < 0.0011);
}

TEST_CASE("equal pictures are alike, negatives are not, and a picture smaller than the window has no similarity") {
    const Image<Rgb> a = noise(20, 15, 5);
    CHECK(ssim(a, a) == doctest::Approx(1).epsilon(1e-12));
    Image<Rgb> negative = a;
    for (Rgb& p : negative.pixels) p = Rgb(1) - p;
    CHECK(ssim(negative, a) < -0.5);
    CHECK(std::isnan(ssim(noise(10, 20, 1), noise(10, 20, 2))));
    // Of two even pictures only the term of means is left.
    const double x = 0.25, y = 0.75;
    CHECK(ssim(Image<Rgb>(11, 11, Rgb(0.25f)), Image<Rgb>(11, 11, Rgb(0.75f))) ==
          doctest::Approx((2 * x * y + 1e-4) / (x * x + y * y + 1e-4)));
}

TEST_CASE("PSNR and SSIM agree with scikit-image") {
    const char* python = "/usr/bin/python3";  // Debian's, which has Debian's packages
    if (std::system((std::string(python) + " -c 'import skimage.metrics' 2>/dev/null").c_str()) != 0) {
        MESSAGE("skipped: needs python3-skimage");
        return;
    }
    const TemporaryFolder folder;
    Image<Rgb> b = noise(61, 47, 3), a = b;
    for (int y = 0; y < b.height; ++y)  // smooth here, noisy there
        for (int x = 0; x < b.width / 2; ++x) b.at(x, y) = Rgb(float(x + y) / 80, float(x) / 60, 0.5f);
    const Image<Rgb> error = noise(61, 47, 4, -0.2f, 0.2f);
    for (size_t i = 0; i < a.pixels.size(); ++i) {
        const Rgb p = b.pixels[i] + error.pixels[i];
        a.pixels[i] = {std::clamp(p.r, 0.0f, 1.0f), std::clamp(p.g, 0.0f, 1.0f), std::clamp(p.b, 0.0f, 1.0f)};
    }
    for (const auto& [name, image] : {std::pair{"a", &a}, {"b", &b}})
        write_file(folder / name, std::string(reinterpret_cast<const char*>(image->pixels.data()),
                                              image->pixels.size() * sizeof(Rgb)));
    write_file(folder / "measure.py", R"(
import sys, numpy
from skimage.metrics import peak_signal_noise_ratio, structural_similarity
a, b = (numpy.fromfile(sys.argv[1] + "/" + n, numpy.float32).astype(numpy.float64).reshape(47, 61, 3) for n in "ab")
print(repr(float(peak_signal_noise_ratio(b, a, data_range=1))))
print(repr(float(structural_similarity(b, a, data_range=1, channel_axis=2, gaussian_weights=True, sigma=1.5,
                                       use_sample_covariance=False))))
)");
    REQUIRE(std::system(
                (std::string(python) + " " + (folder / "measure.py") + " " + folder.path() + " >" + (folder / "out"))
                    .c_str()) == 0);
    std::istringstream out(read_file(folder / "out"));
    double their_psnr = 0, their_ssim = 0;
    out >> their_psnr >> their_ssim;
    // Theirs has no 1e-8.
    CHECK(psnr(a, b) ==
          doctest::Approx(-10 * std::log10(std::pow(10, -their_psnr / 10) + 1e-8)).epsilon(1e-8).scale(0));
    CHECK(std::abs(ssim(a, b) - their_ssim) < 1e-6);
    CHECK(their_ssim < 0.95);
}

TEST_CASE("errors of depth are those of a hand calculation, and what is missing is counted") {
    const float inf = std::numeric_limits<float>::infinity();
    Image<float> a(6, 1), b(6, 1);
    b.pixels = {10, 10, 10, 4, inf, 0};  // the last two have no truth
    a.pixels = {11, 10, 14, inf, 5, 5};  // the fourth is missed
    const DepthErrors e = depth_errors(a, b);
    CHECK(e.abs_rel == doctest::Approx((0.1 + 0 + 0.4) / 3));
    CHECK(e.rmse == doctest::Approx(std::sqrt((1 + 0 + 16) / 3.0)));
    CHECK(e.delta[0] == doctest::Approx(2 / 4.0));
    CHECK(e.delta[1] == doctest::Approx(3 / 4.0));  // 1.4 < 1.5625
    CHECK(e.delta[2] == doctest::Approx(3 / 4.0));
    CHECK(e.missing == doctest::Approx(1 / 4.0));
}

TEST_CASE("agreement of masks is that of a hand calculation, also where one is empty") {
    Image<float> a(4, 1), b(4, 1), empty(4, 1);
    a.pixels = {1, 1, 0.5f, 0.49f};
    b.pixels = {1, 0, 0, 1};
    const MaskAgreement m = mask_agreement(a, b);
    CHECK(m.iou == doctest::Approx(1 / 4.0));
    CHECK(m.precision == doctest::Approx(1 / 3.0));
    CHECK(m.recall == doctest::Approx(1 / 2.0));
    CHECK(mask_agreement(empty, empty).iou == 1);
    CHECK(mask_agreement(empty, b).precision == 0);
    CHECK(mask_agreement(a, empty).recall == 0);
}

TEST_CASE("a limit knows which side of it is worse") {
    CHECK(is_worse(parse_limit("psnr=30"), 29.9));
    CHECK_FALSE(is_worse(parse_limit("PSNR=30"), 30));
    CHECK(is_worse(parse_limit("relmse=0.01"), 0.02));
    CHECK_FALSE(is_worse(parse_limit("relmse=0.01"), 0.01));
    CHECK(is_worse(parse_limit("bias=0.01"), -0.02));
    CHECK_FALSE(is_worse(parse_limit("bias=0.01"), -0.005));
    CHECK(is_worse(parse_limit("ssim=0.1"), std::nan("")));
}

}  // namespace pluvia
