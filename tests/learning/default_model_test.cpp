// The model that comes with Pluvia, on a picture of a camera that it has not learned from.
#include "renderer/image/image_io.h"
#include "tools/learning/synthesis.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>

using namespace pluvia;

namespace {

using Answer = std::array<double, 3>;

/// PSNR of the pixels with rain, dB. answer: what is drawn there.
double psnr_in_rain(const Image<Rgba8>& truth, const Image<uint8_t>& coverage, const auto& answer) {
    double sum = 0;
    size_t n = 0;
    for (size_t i = 0; i < truth.pixels.size(); ++i) {
        if (coverage.pixels[i] < rain_alpha) continue;
        const Rgba8 t = truth.pixels[i];
        const Answer a = answer(i);
        sum += std::pow(a[0] - t.r, 2) + std::pow(a[1] - t.g, 2) + std::pow(a[2] - t.b, 2);
        n += 3;
    }
    REQUIRE(n > 3000);
    return 10 * std::log10(255.0 * 255.0 * double(n) / sum);
}

Answer values(Rgba8 p) {
    return {double(p.r), double(p.g), double(p.b)};
}

}  // namespace

TEST_CASE("in the rain the default model is nearer to the truth than the clean picture, white and the mean colour") {
    const std::string folder = std::string(PLUVIA_SOURCE_DIR) + "/tests/learning/held_out/";
    const auto clean = read_rgba8(folder + "clean.jpg"), truth = read_rgba8(folder + "rainy.png");
    const auto coverage = rain_coverage(read_rgba8(folder + "layer.png"));
    set_learning_threads(1);
    const auto model = load_model(std::string(PLUVIA_SOURCE_DIR) + "/tools/learning/rain.safetensors");
    const auto drawn = synthesize(*model, clean, coverage, {});
    // The best that one colour for all streaks of the picture can do.
    Answer mean = {};
    size_t n = 0;
    for (size_t i = 0; i < truth.pixels.size(); ++i)
        if (coverage.pixels[i] >= rain_alpha) {
            const Answer t = values(truth.pixels[i]);
            for (int c = 0; c < 3; ++c) mean[c] += t[c];
            ++n;
        }
    for (double& m : mean) m /= double(n);
    const double model_db = psnr_in_rain(truth, coverage, [&](size_t i) { return values(drawn.pixels[i]); });
    const double clean_db = psnr_in_rain(truth, coverage, [&](size_t i) { return values(clean.pixels[i]); });
    const double white_db = psnr_in_rain(truth, coverage, [&](size_t) { return Answer{255, 255, 255}; });
    const double mean_db = psnr_in_rain(truth, coverage, [&](size_t) { return mean; });
    CAPTURE(model_db);
    CAPTURE(clean_db);
    CAPTURE(white_db);
    CAPTURE(mean_db);
    CHECK(model_db > clean_db + 1);
    CHECK(model_db > white_db + 1);
    CHECK(model_db > mean_db + 1);
}
