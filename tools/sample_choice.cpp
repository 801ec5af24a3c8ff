#include "tools/sample_choice.h"

#include "renderer/core/random.h"
#include "tools/validate/color_metrics.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace pluvia {
namespace {

constexpr uint64_t pilot_domain = 0x70696c6f74;  // "pilot": keeps its random numbers apart from the picture's

/// So many different pixels, one from each of as many equal parts of the picture; all where it has no more.
std::vector<int64_t> scattered_pixels(int64_t picture_size, int64_t count, uint64_t seed) {
    count = std::min(count, picture_size);
    std::vector<int64_t> pixels;
    for (int64_t i = 0; i < count; ++i) {
        const int64_t begin = picture_size * i / count, end = picture_size * (i + 1) / count;
        pixels.push_back(begin + int64_t(unit_double(hash_key(seed, pilot_domain, uint64_t(i))) * double(end - begin)));
    }
    return pixels;
}

/// First channels of the pictures whose error counts.
std::vector<size_t> judged_layers(const std::vector<double>& intensities) {
    const auto channels = layer_channels(intensities);
    const auto find = [&](const std::string& name) {
        return size_t(std::find(channels.begin(), channels.end(), name) - channels.begin());
    };
    std::vector<size_t> layers = {find("background.R")};
    if (!intensities.empty())
        layers.push_back(
            find("rainy_" + intensity_label(*std::max_element(intensities.begin(), intensities.end())) + ".R"));
    return layers;
}

Image<Rgb> layer_of(const std::vector<float>& values, size_t channels, size_t first) {
    Image<Rgb> image(int(values.size() / channels), 1);
    for (size_t i = 0; i < image.pixels.size(); ++i) {
        const float* v = &values[i * channels + first];
        image.pixels[i] = {v[0], v[1], v[2]};
    }
    return image;
}

/// Trimmed relMSE of one of two independent pictures against the truth: each is off from it by half of the square by
/// which they differ.
double error_of_halves(const Image<Rgb>& a, const Image<Rgb>& b, const Image<Rgb>& truth) {
    Image<Rgb> apart = truth;
    for (size_t i = 0; i < apart.pixels.size(); ++i)
        apart.pixels[i] = truth.pixels[i] + (a.pixels[i] - b.pixels[i]) * std::sqrt(0.5f);
    return trimmed_mean(relative_squared_errors(apart, truth));
}

class Pilot {
public:
    Pilot(const PixelRenderer& render_pixels, const std::vector<double>& intensities, std::vector<int64_t> pixels,
          uint64_t seed)
        : render_pixels_(render_pixels),
          channels_(layer_channels(intensities).size()),
          layers_(judged_layers(intensities)),
          pixels_(std::move(pixels)),
          seed_(seed),
          sums_(2 * layers_.size(), Image<Rgb>(int(pixels_.size()), 1)) {}

    /// Largest error of the layers at so many samples. Counts must differ from call to call.
    double squared_error(int samples) {
        const auto a = values(samples, 0), b = values(samples, 1);
        total_ += samples;
        double largest = 0;
        for (size_t l = 0; l < layers_.size(); ++l) {
            const Image<Rgb> x = layer_of(a, channels_, layers_[l]), y = layer_of(b, channels_, layers_[l]);
            Image<Rgb>&sum_a = sums_[2 * l], &sum_b = sums_[2 * l + 1], truth = sum_a;
            for (size_t i = 0; i < truth.pixels.size(); ++i) {
                sum_a.pixels[i] += x.pixels[i] * float(samples);
                sum_b.pixels[i] += y.pixels[i] * float(samples);
                truth.pixels[i] = truth_of_halves(sum_a.pixels[i], sum_b.pixels[i]) / float(total_);
            }
            largest = std::max(largest, error_of_halves(x, y, truth));
        }
        return largest;
    }

private:
    std::vector<float> values(int samples, uint64_t half) const {
        return render_pixels_(pixels_, samples, hash_key(seed_, pilot_domain, uint64_t(samples) * 2 + half));
    }

    const PixelRenderer& render_pixels_;
    size_t channels_;
    std::vector<size_t> layers_;
    std::vector<int64_t> pixels_;
    uint64_t seed_;
    std::vector<Image<Rgb>> sums_;  // per layer and half, of all samples so far
    int total_ = 0;                 // of a half
};

}  // namespace

Rgb truth_of_halves(Rgb a, Rgb b) {
    constexpr float least = 0.6f;
    const auto root = [](float x, float y) {
        const float mean = 0.5f * (x + y);
        return std::sqrt(std::max(x * y, least * mean * (least * mean)));
    };
    return {root(a.r, b.r), root(a.g, b.g), root(a.b, b.b)};
}

int samples_for_error(double error, const PixelRenderer& render_pixels, const std::vector<double>& intensities,
                      int64_t picture_size, uint64_t seed) {
    constexpr int64_t pixel_count = 8192;  // 0.1 % of them, which the trimmed mean leaves out, are still a few
    Pilot pilot(render_pixels, intensities, scattered_pixels(picture_size, pixel_count, seed), seed);
    const double wanted = error * error;
    double before = 0, rate = 1;
    for (int samples = 4;; samples *= 4) {
        const double got = pilot.squared_error(samples);
        // Well spread samples let the error fall faster than chance would, rare bright ones hide the error at first.
        if (before > 0 && got > 0) rate = std::clamp(std::log(before / got) / std::log(4.0), 0.7, 1.4);
        const double needed = samples * std::pow(got / wanted, 1 / rate);
        // Hardly farther than what was measured: with few samples light that is rare makes the error look as if it fell
        // faster than it does, and a lane asked for 0.2 got 0.28.
        if (needed <= 1.5 * samples || samples > most_samples / 16)
            return int(std::clamp(std::ceil(needed), 1.0, double(most_samples)));
        before = got;
    }
}

}  // namespace pluvia
