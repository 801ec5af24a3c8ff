// Samples in passes: as many as a time has room for, and the picture of their sum.
#include "tools/time_limit.h"
#include "renderer/scene/gltf.h"
#include "renderer/transport/passes.h"
#include "tests/run_program.h"
#include "tests/temporary_folder.h"
#include "tools/validate/known_scenes.h"
#include "tools/validate/rendered_picture.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>

namespace pluvia {
namespace {

/// Seconds at which a machine is done, files included, that takes so long for a sample and gets slower by a factor.
double simulated_end(double limit, double per_sample, double write, double slow_from, double slower, int& samples) {
    double now = 0.5;  // the scene is loaded
    TimeLimit time_limit(limit, [&] { return now; });
    const auto work = [&](double seconds) {
        const double quick = std::clamp(slow_from - now, 0.0, seconds);
        now += quick + (seconds - quick) * slower;
    };
    samples = 0;
    while (const int more = time_limit.next_pass()) {
        work(more * per_sample + 1e-3);
        if (samples == 0) time_limit.reserve(write);
        samples += more;
        REQUIRE(now < 100 * limit);
    }
    work(write);
    return now;
}

Scene roofed_court() {
    Scene scene = make_court(lambert(Rgb(0.6f)));
    add_box(scene, {-4, 4, -1}, {-1, 4.2f, 4}, lambert(Rgb(0.3f)));  // keeps rain away
    return scene;
}

Picture rendered_in_passes(const Scene& scene, const Environment& world, const View& view,
                           const RenderSettings& settings, const NextPass& next_pass) {
    Picture picture;
    picture.width = view.width, picture.height = view.height;
    const auto names = layer_channels(settings.rain.intensities_mm_per_h);
    picture.report = render_in_passes(
        scene, world, view, settings, next_pass,
        [&](const Band& band) {
            for (size_t c = 0; c < names.size(); ++c)
                picture.planes[names[c]].insert(picture.planes[names[c]].end(), band.planes[c].begin(),
                                                band.planes[c].end());
        },
        [](double) { return true; });
    return picture;
}

}  // namespace

TEST_CASE("passes fill a limit and no more, also when the machine gets three times slower on the way") {
    int samples = 0;
    for (const double per_sample : {1e-4, 0.003, 0.05, 0.7}) {
        CAPTURE(per_sample);
        const double even = simulated_end(10, per_sample, 0.3, 1e9, 1, samples);
        CHECK(even <= 10.002);  // passes of a sample or two at the end, and the millisecond that each begins with
        CHECK(even > 10 - 0.2 - 1.1 * per_sample);
        if (per_sample > 0.2) continue;  // a pass of one sample may be longer than what is allowed
        // Until the files are written, whose time is then a guess.
        for (double from = 0.5; from < 9; from += 0.37) {
            CAPTURE(from);
            CHECK(simulated_end(10, per_sample, 0.03, from, 3, samples) < 10.5);
        }
    }
    CHECK(simulated_end(10, 25, 0.3, 1e9, 1, samples) > 25);
    CHECK(samples == 1);  // one at least
}

TEST_CASE("samples that come in passes make the bytes, ids and counts of one pass") {
    const Scene scene = roofed_court();
    const Environment world = Environment::uniform(Rgb(0.5f));
    const View view = court_view(37, 29);
    RenderSettings settings{.samples = 9, .seed = 5};
    settings.rain.intensities_mm_per_h = {20, 100};
    const Picture whole = render_picture(scene, world, view, settings);
    settings.samples = 1;
    const Picture first = render_picture(scene, world, view, settings);
    for (const int tile_size : {32, 6}) {
        std::vector<int> passes = {1, 5, 3, 0};
        size_t next = 0;
        settings.tile_size = tile_size;
        const NextPass next_pass = [&](int done, const BandPreview& preview) {
            if (done == 1) {
                const Band rows = preview(7, 11);
                REQUIRE(rows.planes.size() == layer_channels({20, 100}).size());
                for (size_t c = 0; c < rows.planes.size(); ++c) {
                    const std::vector<float>& plane = first.plane(layer_channels({20, 100})[c]);
                    CHECK(std::equal(rows.planes[c].begin(), rows.planes[c].end(), plane.begin() + 7 * 37));
                }
            }
            return passes[next++];
        };
        const Picture summed = rendered_in_passes(scene, world, view, settings, next_pass);
        CHECK(summed == whole);
        CHECK(summed.report.samples == 9);
        if (tile_size == 32) CHECK(summed.report.counters.calls == whole.report.counters.calls);
        CHECK(whole.report.counters[Feature::rain_shadow] > 0);
    }
}

TEST_CASE("render --time-limit records the count that fitted, and --spp with it gives all its files") {
    const TemporaryFolder folder;
    save_glb(roofed_court(), folder / "court.glb");
    const std::string common = "render " + (folder / "court.glb") +
                               " --size 48x32 --environment 1,1,1 --progress none --json --rain 50 --seed 3 "
                               "--layers all -o " +
                               folder.path();
    const Outcome a = run_program(common + "/a --time-limit 2");
    CAPTURE(a.err);
    REQUIRE(a.exit_code == 0);
    const int samples = nlohmann::json::parse(a.out)["samples"];
    CHECK(samples > 1);
    const Outcome b = run_program(common + "/b --spp " + std::to_string(samples));
    REQUIRE(b.exit_code == 0);
    size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "a")) {
        const std::string name = entry.path().filename();
        CAPTURE(name);
        CHECK((read_file(folder / ("a/" + name)) == read_file(folder / ("b/" + name))));
        ++files;
    }
    CHECK(files == 7);  // nothing is left of the trial
    CHECK(run_program(common + "/c --time-limit 0").exit_code == 2);
    CHECK(run_program(common + "/c --time-limit 2 --spp 4").exit_code == 2);
    CHECK(run_program(common + "/c --time-limit 2 --target-error 0.1").exit_code == 2);
}

}  // namespace pluvia
