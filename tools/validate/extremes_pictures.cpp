// The smallest and largest pictures, and the fewest and most samples.
#include "tools/validate/extremes.h"
#include "tools/validate/known_scenes.h"
#include "tools/validate/running_mean.h"

#include <fmt/format.h>

#include <sys/resource.h>

#include <cmath>

namespace pluvia {
namespace {

/// Most memory that the program has used so far, in MB.
double peak_memory() {
    rusage usage = {};
    getrusage(RUSAGE_SELF, &usage);
    return double(usage.ru_maxrss) / 1024;
}

}  // namespace

std::vector<ExtremeResult> measure_picture_extremes(bool full) {
    std::vector<ExtremeResult> results;
    const Environment world = Environment::uniform(Rgb(1));
    const Scene court = make_court(lambert(Rgb(1))), shining = make_court(emitter(Rgb(1)));
    RenderSettings rain{.samples = 256};
    rain.rain.intensities_mm_per_h = {100};
    results.push_back(mean_result("picture of 1 pixel, furnace in rain", 1,
                                  sound_means(court, world, court_view(1, 1), rain, "rainy_100.G", full ? 64 : 8),
                                  1e-5));
    {
        const View view = court_view(full ? 16384 : 4096, full ? 8192 : 16);
        const double before = peak_memory();
        double sum = 0;
        int64_t rows = 0;
        render(
            shining, world, view, {.samples = 1},
            [&](const Band& band) {
                rows += band.rows;
                for (const float v : band.planes[1]) sum += v;
            },
            [](double) { return true; });
        const std::string size = fmt::format("picture of {} x {}", view.width, view.height);
        results.push_back(
            {size + ": court that shines as the sky does", 1, sum / (double(view.width) * view.height), 1e-5});
        results.push_back({size + ": rows that arrive", double(view.height), double(rows), 0});
        // Only the rows in work are held: 16 bands of 32 rows of 5 channels and more, a third of a GB here.
        results.push_back({size + ": MB of memory beyond 400", 0, std::max(0.0, peak_memory() - before - 400), 0});
    }
    // A surface that lets half of the light pass: samples are 0 or 1.
    Scene veil;
    Material half = emitter(Rgb(1));
    half.alpha_mode = AlphaMode::blend, half.alpha = 0.5f;
    add_quad(veil, {-100, -100, -1}, {200, 0, 0}, {0, 200, 0}, half);
    const View pixel = look_at({0, 0, 0}, {0, 0, -1}, full ? 8 : 2, 2, 8);
    const Picture once = render_picture(veil, Environment(), pixel, {.samples = 1});
    double apart = 0;
    for (const float v : once.plane("background.G")) apart = std::max(apart, double(std::min(v, std::abs(v - 1))));
    results.push_back({"one sample of what is 0 or 1: distance from either", 0, apart, 0});
    const int many = full ? 1'000'000 : 100'000;
    results.push_back({fmt::format("half transparent card, {} samples", many), 0.5,
                       sound_mean(render_picture(veil, Environment(), pixel, {.samples = many}), "background.G"),
                       5 * 0.5 / std::sqrt(many * double(pixel.width * pixel.height))});
    // Where sums were in single precision, ones would stop to count at 1.7e7 and 0.1 would drift by 1e-3 before.
    Scene dim;
    add_quad(dim, {-100, -100, -1}, {200, 0, 0}, {0, 200, 0}, emitter(Rgb(0.1f)));
    results.push_back(relative_result(
        fmt::format("even card of 0.1 cd/m2, {} samples", many), 0.1f,
        sound_mean(render_picture(dim, Environment(), pixel, {.samples = many}), "background.G"), 1e-7));
    return results;
}

}  // namespace pluvia
