// That a count is chosen from the picture's own look must not show in the mean of many pictures.
#include "tools/sample_choice.h"
#include "tools/validate/known_scenes.h"
#include "tools/validate/rendered_picture.h"
#include "tools/validate/running_mean.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pluvia {
namespace {

const View view = court_view(32, 16);
constexpr int deciles = 10;

std::vector<float> background(RenderSettings settings) {
    return render_picture(make_court(lambert(Rgb(0.6f))), Environment::uniform(Rgb(1)), view, settings)
        .plane("background.G");
}

/// Pixels from dark to bright in ten parts, by a picture that nothing else is compared with.
std::vector<std::vector<size_t>> pixels_by_brightness() {
    const std::vector<float> picture = background({.samples = 1024, .seed = 900});
    std::vector<size_t> order(picture.size());
    std::iota(order.begin(), order.end(), size_t(0));
    std::ranges::sort(order, [&](size_t a, size_t b) { return picture[a] < picture[b]; });
    std::vector<std::vector<size_t>> parts(deciles);
    for (size_t i = 0; i < order.size(); ++i) parts[i * deciles / order.size()].push_back(order[i]);
    return parts;
}

double mean_of(const std::vector<float>& picture, const std::vector<size_t>& pixels) {
    return std::accumulate(pixels.begin(), pixels.end(), 0.0, [&](double sum, size_t i) { return sum + picture[i]; }) /
           double(pixels.size());
}

/// Of each decile the means of pictures with seeds of their own.
template <class Choose>
std::vector<RunningMean> means(const std::vector<std::vector<size_t>>& parts, int runs, uint64_t first_seed,
                               RenderSettings settings, Choose choose) {
    std::vector<RunningMean> found(parts.size());
    for (int run = 0; run < runs; ++run) {
        settings.seed = first_seed + uint64_t(run);
        choose(settings);
        const std::vector<float> picture = background(settings);
        for (size_t k = 0; k < parts.size(); ++k) found[k].add(mean_of(picture, parts[k]));
    }
    return found;
}

TEST_CASE("a count that a pilot chooses biases no decile of brightness by 0.1 %; one chosen by its own samples does" *
          doctest::skip()) {
    const auto parts = pixels_by_brightness();
    const auto truth = means(parts, 1000, 10'000, {.samples = 256}, [](RenderSettings&) {});
    const auto piloted = means(parts, 5000, 20'000, {}, [](RenderSettings& s) {
        s.choose_samples = [&s](const PixelRenderer& pilot) {
            return samples_for_error(0.08, pilot, {}, int64_t(view.width) * view.height, s.seed);
        };
    });
    // Stops after two samples where these came out bright.
    const auto cheating = means(parts, 1000, 30'000, {}, [&](RenderSettings& s) {
        s.choose_samples = [&](const PixelRenderer& pilot) {
            std::vector<int64_t> all(size_t(view.width) * view.height);
            std::iota(all.begin(), all.end(), int64_t(0));
            const std::vector<float> values = pilot(all, 2, s.seed);
            const double mean = std::accumulate(values.begin(), values.end(), 0.0);
            static double usual = mean;
            usual += 0.02 * (mean - usual);
            return mean > usual ? 2 : 32;
        };
    });
    int seen = 0;
    for (int k = 0; k < deciles; ++k) {
        const double expected = truth[k].mean();
        const auto error = [&](const RunningMean& m) {
            return std::hypot(m.standard_error(), truth[k].standard_error());
        };
        CAPTURE(k);
        CHECK(error(piloted[k]) < 0.0003 * expected);  // enough to see 0.1 %
        CHECK(std::abs(piloted[k].mean() - expected) < 0.001 * expected);
        CHECK(std::abs(piloted[k].mean() - expected) < 5 * error(piloted[k]));
        MESSAGE("decile " << k << ": piloted " << piloted[k].mean() / expected << " +- " << error(piloted[k]) / expected
                          << ", cheating " << cheating[k].mean() / expected << " +- " << error(cheating[k]) / expected);
        seen += cheating[k].mean() - expected > 5 * error(cheating[k]);
    }
    CHECK(seen > 0);
}

}  // namespace
}  // namespace pluvia
