#include "tools/learning/blend.h"

#include "renderer/core/parallel.h"
#include "renderer/image/color.h"

#include <algorithm>
#include <array>

namespace pluvia {
namespace {

/// Sums of residuals and their number.
using Sums = std::array<float, 4>;

/// Mean over 2 radius + 1 values along a line, zero beyond its ends. Strides in values.
void box_blur(const Sums* from, Sums* to, int count, int stride, int radius) {
    std::array<double, 4> sum = {};
    const double scale = 1.0 / (2 * radius + 1);
    const auto add = [&](int i, double sign) {
        if (i < 0 || i >= count) return;
        for (int c = 0; c < 4; ++c) sum[c] += sign * from[size_t(i) * stride][c];
    };
    for (int i = 0; i < radius; ++i) add(i, 1);
    for (int i = 0; i < count; ++i) {
        add(i + radius, 1);
        add(i - radius - 1, -1);
        for (int c = 0; c < 4; ++c) to[size_t(i) * stride][c] = float(sum[c] * scale);
    }
}

/// Three boxes along each axis are a Gaussian but for its far tails.
void gaussian_blur(Image<Sums>& image, int sigma) {
    Image<Sums> other(image.width, image.height);
    const int radius = std::max(1, sigma - 1);  // variance of three boxes: (2 r + 1)^2 / 4 - 1/4, about (r + 1/2)^2
    for (int pass = 0; pass < 3; ++pass) {
        parallel_for(image.height, [&](int y) { box_blur(&image.at(0, y), &other.at(0, y), image.width, 1, radius); });
        parallel_for(image.width,
                     [&](int x) { box_blur(&other.at(x, 0), &image.at(x, 0), image.height, image.width, radius); });
    }
}

Rgb display(Rgba8 p) {
    return Rgb(float(p.r), float(p.g), float(p.b)) * (1 / 255.0f);
}

}  // namespace

Image<uint8_t> rain_coverage(const Image<Rgba8>& mask) {
    const bool has_alpha =
        std::any_of(mask.pixels.begin(), mask.pixels.end(), [](const Rgba8& p) { return p.a != 255; });
    Image<uint8_t> coverage(mask.width, mask.height);
    std::transform(mask.pixels.begin(), mask.pixels.end(), coverage.pixels.begin(),
                   [&](const Rgba8& p) { return has_alpha ? p.a : p.r; });
    return coverage;
}

void anchor_colors(Image<Rgb>& prediction, const Image<Rgba8>& background, const Image<uint8_t>& coverage, int sigma) {
    Image<Sums> known(prediction.width, prediction.height);
    for (size_t i = 0; i < known.pixels.size(); ++i)
        if (coverage.pixels[i] < rain_alpha) {
            const Rgb r = display(background.pixels[i]) - prediction.pixels[i];
            known.pixels[i] = {r.r, r.g, r.b, 1};
        }
    Image<Sums> far = known;
    gaussian_blur(known, sigma);
    gaussian_blur(far, 4 * sigma);
    for (size_t i = 0; i < known.pixels.size(); ++i) {
        const Sums &n = known.pixels[i], &f = far.pixels[i];
        // Both means have their weights in them: where a tenth of the near pixels are known they decide.
        constexpr float far_share = 0.01f;
        const float weight = n[3] + far_share * f[3];
        if (weight < 1e-6f) continue;  // rain all around: nothing is known
        prediction.pixels[i] += Rgb(n[0] + far_share * f[0], n[1] + far_share * f[1], n[2] + far_share * f[2]) / weight;
    }
}

Image<Rgba8> blend(Image<Rgb> prediction, const Image<Rgba8>& background, const Image<uint8_t>& coverage,
                   const BlendSettings& settings) {
    if (settings.anchor_colors) anchor_colors(prediction, background, coverage);
    Image<Rgba8> result = background;
    for (size_t i = 0; i < result.pixels.size(); ++i) {
        const int alpha = coverage.pixels[i];
        if (alpha < rain_alpha) continue;
        const Rgb clean = display(background.pixels[i]);
        Rgb rainy = prediction.pixels[i];
        if (settings.lighten)
            rainy = {std::max(rainy.r, clean.r), std::max(rainy.g, clean.g), std::max(rainy.b, clean.b)};
        const float weight =
            settings.soft ? std::min(1.0f, float(alpha - rain_alpha + 1) / (full_alpha - rain_alpha + 1)) : 1.0f;
        const Rgb p = mix(clean, rainy, weight);
        result.pixels[i] = {byte_from_display(p.r), byte_from_display(p.g), byte_from_display(p.b),
                            background.pixels[i].a};
    }
    return result;
}

}  // namespace pluvia
