// Rain in front of a picture with depth: the other source of camera segments.
#include "renderer/transport/picture_scene.h"
#include "tests/statistics.h"
#include "tests/test_scenes.h"

#include <doctest/doctest.h>

#include <cmath>

namespace pluvia {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

Picture augment_picture(const PictureSource& source, const View& view, const RenderSettings& settings,
                        const Environment* environment = nullptr) {
    const Scene scene = make_picture_scene(source, view);
    return render_picture(scene, environment ? *environment : estimate_environment(source, view), view, settings,
                          &source);
}

/// The clean picture and depth of a render.
PictureSource source_of(const Picture& rendered) {
    PictureSource source{Image<Rgb>(rendered.width, rendered.height), Image<float>(rendered.width, rendered.height)};
    for (size_t i = 0; i < source.z.pixels.size(); ++i) {
        source.radiance.pixels[i] = {rendered.plane("background.R")[i], rendered.plane("background.G")[i],
                                     rendered.plane("background.B")[i]};
        source.z.pixels[i] = rendered.plane("Z")[i];
    }
    return source;
}

RenderSettings rainy(int samples) {
    RenderSettings settings;
    settings.samples = samples;
    settings.seed = settings.rain.seed = 11;
    settings.rain.intensities_mm_per_h = {10, 100};
    settings.rain.min_width_pixels = 0.05;  // a small picture has few drops a pixel wide
    return settings;
}

/// An open place: nothing keeps rain away. Ground and a wall far behind, red and grey, under an even sky.
Scene open_place() {
    Scene scene = make_plane(lambert(Rgb(0.4f)));
    add_quad(scene, {-40, 0, -30}, {80, 0, 0}, {0, 12, 0}, lambert(Rgb(0.6f, 0.2f, 0.2f)));
    return scene;
}

}  // namespace

TEST_CASE("a render augmented from its own background and depth has its own coverage, drop for drop") {
    const Scene scene = open_place();
    const Environment world = Environment::uniform(Rgb(1, 1.1f, 1.3f));
    // No streak is near a surface: there the depth inside of a pixel decides, of which a picture knows one value.
    const View view = look_at({0, 1.6, 6}, {0, 3.2, 0}, 160, 80, 400);
    for (const Composition composition : {Composition::physical, Composition::paper}) {
        RenderSettings settings = rainy(16);
        settings.streaks.composition = composition;
        settings.rain.min_width_pixels = 0.25;
        const Picture rendered = render_picture(scene, world, view, settings);
        const Picture augmented = augment_picture(source_of(rendered), view, settings);
        CAPTURE(int(composition));
        CHECK(rendered.mean("rain_100.A") > 1e-3);
        for (const char* channel : {"rain_010.A", "rain_100.A", "rain_wide_100.A"})
            CHECK(rendered.plane(channel) == augmented.plane(channel));
        CHECK(rendered.plane("rainy_Z_100") == augmented.plane("rainy_Z_100"));
    }
}

TEST_CASE("rain on a render's own background has the light of its own rainy picture, as far as the picture shows it") {
    // 59 % of a drop's light come from within 30 degrees of straight on and 94 % from the half space behind it. Where
    // the street goes on beside the picture as its edges show, the estimate is right. A lens of 23 degrees that shows a
    // dark red wall knows nothing of the sky above it, which brings the drops two thirds of their green light.
    struct Case {
        const char* name;
        bool wall;
        double focal;  // of 64 pixels
        double least, most;
    };
    // Below the horizon as bright as the ground, which ends somewhere.
    Image<Rgb> around(64, 32, Rgb(1, 1.1f, 1.3f));
    for (int y = 16; y < 32; ++y)
        for (int x = 0; x < 64; ++x) around.at(x, y) *= 0.4f;
    const Environment world(std::move(around));
    for (const Case c :
         {Case{"all is shown", false, 32, 0.97, 1.03}, Case{"a wall hides the sky", true, 160, 0.33, 1}}) {
        Scene scene = make_plane(lambert(Rgb(0.4f)));
        if (c.wall) scene = open_place();
        const View view = look_at({0, 1.6, 6}, {0, 2.2, 0}, 64, 32, c.focal);
        RenderSettings settings = rainy(16);
        RunningMean own, traced, smooth;
        for (uint64_t seed = 0; seed < 6; ++seed) {
            settings.seed = settings.rain.seed = seed;
            settings.streaks.tabled_veil = false;
            const Picture rendered = render_picture(scene, world, view, settings);
            const PictureSource source = source_of(rendered);
            const Environment estimated = estimate_environment(source, view);
            const auto light = [](const Picture& p) { return p.mean("rain_100.G") + p.mean("inscatter_100.G"); };
            own.add(light(rendered));
            traced.add(light(augment_picture(source, view, settings)));
            settings.streaks.tabled_veil = true;
            settings.streaks.far_light = std::make_shared<FarLight>(make_far_light(source, view, estimated));
            smooth.add(light(augment_picture(source, view, settings)));
        }
        CAPTURE(c.name);
        for (const RunningMean& mean : {traced, smooth}) {
            const double ratio = mean.mean() / own.mean();
            CAPTURE(ratio);
            CHECK(ratio > c.least);
            CHECK(ratio < c.most);
        }
    }
}

TEST_CASE("light of fine drops from a table is that of their paths, by day and beside a lamp") {
    const View view = look_at({0, 1.6, 0}, {0, 1.6, -1}, 64, 64, 64);
    PictureSource source{Image<Rgb>(64, 64), Image<float>(64, 64, 20)};
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) source.radiance.at(x, y) = y < 32 ? Rgb(3, 3.5f, 4) : Rgb(1, 0.9f, 0.8f);
    for (int y = 34; y < 64; ++y)
        for (int x = 0; x < 64; ++x) source.z.at(x, y) = 40.0f / float(y - 32);
    for (const bool night : {false, true}) {
        if (night) {
            for (Rgb& c : source.radiance.pixels) c *= 0.003f;
            for (int y = 28; y < 32; ++y)
                for (int x = 30; x < 34; ++x) source.radiance.at(x, y) = Rgb(100);
        }
        const Environment environment = estimate_environment(source, view);
        RenderSettings settings = rainy(16);
        // Sums over rings around the lamp: on it, near it, farther away. Means of 8 seeds err by 4 % on it, 1 %
        // elsewhere.
        std::array<std::array<RunningMean, 3>, 2> rings;
        for (uint64_t seed = 0; seed < 8; ++seed)
            for (const bool smooth : {false, true}) {
                settings.seed = settings.rain.seed = seed;
                settings.streaks.tabled_veil = smooth;
                settings.streaks.far_light = std::make_shared<FarLight>(make_far_light(source, view, environment));
                const Picture picture = augment_picture(source, view, settings, &environment);
                CHECK((picture.report.counters[Feature::medium_path] > 0) == !smooth);
                std::array<double, 3> sums = {};
                for (int y = 0; y < 64; ++y)
                    for (int x = 0; x < 64; ++x) {
                        const int away = int(std::hypot(x - 31.5, y - 29.5));
                        const size_t i = size_t(y) * 64 + size_t(x);
                        sums[away < 4    ? 0
                             : away < 12 ? 1
                                         : 2] += picture.plane("rain_100.G")[i] + picture.plane("inscatter_100.G")[i];
                    }
                for (size_t k = 0; k < 3; ++k) rings[smooth][k].add(sums[k]);
            }
        for (size_t k = 0; k < 3; ++k) {
            CAPTURE(night);
            CAPTURE(k);
            const double ratio = rings[1][k].mean() / rings[0][k].mean();
            CAPTURE(ratio);
            CHECK(std::abs(ratio - 1) < (night && k == 0 ? 0.12 : 0.04));
        }
    }
}

TEST_CASE("in a picture of one grey rain is invisible, with its depth, its sky and an environment of its own") {
    const View view = look_at({0, 1.6, 0}, {0, 2, -1}, 48, 24, 48);
    PictureSource source{Image<Rgb>(48, 24, Rgb(1)), Image<float>(48, 24, infinity)};
    for (int y = 13; y < 24; ++y)
        for (int x = 0; x < 48; ++x) source.z.at(x, y) = 60.0f / float(y - 10);
    RenderSettings settings = rainy(16);
    // Traced, and with the table in the second half of the seeds.
    settings.streaks.far_light =
        std::make_shared<FarLight>(make_far_light(source, view, estimate_environment(source, view)));
    std::vector<RunningMean> pixels(48 * 24);
    RunningMean all, light;
    for (uint64_t seed = 0; seed < 64; ++seed) {
        settings.seed = settings.rain.seed = seed;
        settings.streaks.tabled_veil = seed >= 32;
        const Picture picture = augment_picture(source, view, settings);
        CHECK((picture.report.counters[Feature::medium_path] > 0) == (seed < 32));
        for (size_t i = 0; i < pixels.size(); ++i) pixels[i].add(picture.plane("rainy_100.G")[i]);
        light.add(picture.mean("rain_100.G"));
    }
    int outliers = 0;
    for (const RunningMean& pixel : pixels) {
        all.add(pixel.mean());
        outliers += !pixel.agrees_with(1, 1e-6);
    }
    CHECK(light.mean() > 1e-3);
    CAPTURE(all.mean());
    CHECK(std::abs(all.mean() - 1) < 1e-3);  // 1.2 million samples of which rain takes some per cent away
    CHECK(outliers == 0);
}

TEST_CASE("rain leaves the picture and its layers add up to the rainy one") {
    const View view = look_at({0, 1.6, 0}, {0, 2, -1}, 48, 24, 48);
    PictureSource source{Image<Rgb>(48, 24), Image<float>(48, 24, 30)};
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 48; ++x) source.radiance.at(x, y) = Rgb(float(x), float(y), 7);
    const Picture picture = augment_picture(source, view, rainy(8));
    for (size_t i = 0; i < source.z.pixels.size(); ++i) {
        CHECK(picture.plane("background.R")[i] ==
              doctest::Approx(source.radiance.pixels[i].r).epsilon(1e-6).scale(1e-20));
        CHECK(picture.plane("Z")[i] == doctest::Approx(30).epsilon(1e-6));
        const float sum = picture.plane("background.G")[i] * picture.plane("transmittance_100.G")[i] +
                          picture.plane("rain_100.G")[i] + picture.plane("inscatter_100.G")[i];
        CHECK(picture.plane("rainy_100.G")[i] == doctest::Approx(sum).epsilon(1e-5).scale(1e-20));
    }
    CHECK(picture.report.counters[Feature::rain_shadow] == 0);
    CHECK(picture.report.sheltered_streaks == 0);
}

TEST_CASE("bright places of a picture light the drops around them") {
    // A lamp of 4 x 4 pixels in a dark street, 20 m away.
    const View view = look_at({0, 1.6, 0}, {0, 1.6, -1}, 64, 64, 64);
    PictureSource source{Image<Rgb>(64, 64, Rgb(0.01f)), Image<float>(64, 64, 20)};
    for (int y = 30; y < 34; ++y)
        for (int x = 30; x < 34; ++x) source.radiance.at(x, y) = Rgb(100);
    const Scene scene = make_picture_scene(source, view);
    CHECK(scene.instances.size() == 2);
    const Environment environment = estimate_environment(source, view);
    // The lamp is a light of its own; the environment has none of it.
    CHECK(luminance(environment.mean_radiance()) < 0.1);
    RenderSettings settings = rainy(16);
    const Picture picture = render_picture(scene, environment, view, settings, &source);
    CHECK(picture.report.counters[Feature::medium_lamp] > 0);
    const auto inscatter = [&](int x, int y) {
        double sum = 0;
        for (int j = y - 4; j < y + 4; ++j)
            for (int i = x - 4; i < x + 4; ++i) sum += picture.plane("inscatter_100.G")[size_t(j) * 64 + size_t(i)];
        return sum;
    };
    CHECK(inscatter(24, 32) > 5 * inscatter(6, 6));
}

TEST_CASE("the part of a picture has the drops of the whole: a centre beside the middle crops") {
    View whole = look_at({0, 1.6, 0}, {0, 2, -1}, 96, 48, 200);
    View part = whole;
    part.width = 60, part.height = 30;
    part.centre_offset = {48 - 30, 24 - 15};
    const PictureSource wall{Image<Rgb>(96, 48, Rgb(1)), Image<float>(96, 48, 30)};
    const PictureSource wall_part{Image<Rgb>(60, 30, Rgb(1)), Image<float>(60, 30, 30)};
    const RenderSettings settings = rainy(8);
    const Picture a = augment_picture(wall, whole, settings), b = augment_picture(wall_part, part, settings);
    CHECK(b.mean("rain_100.A") > 1e-3);
    int different = 0;
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 60; ++x)
            different += a.plane("rain_100.A")[size_t(y) * 96 + size_t(x)] !=
                         doctest::Approx(b.plane("rain_100.A")[size_t(y) * 60 + size_t(x)]).epsilon(1e-4).scale(0);
    CHECK(different == 0);
}

TEST_CASE("a stereo pair sees the same drops, near ones shifted by focal length times baseline over depth") {
    // Beyond 2 m away nothing is drawn: the wall stands there.
    constexpr double focal = 400, baseline = 0.05;
    const View left = look_at({0, 1.6, 0}, {0, 1.6, -1}, 128, 64, focal);
    View right = left;
    right.position = left.position + left.right * baseline;
    RainSettings rain;
    rain.intensities_mm_per_h = {100};
    rain.min_width_pixels = 0.25;
    const std::vector<Streak> a = find_streaks(left, rain), b = find_streaks(right, rain);
    int pairs = 0;
    for (const Streak& l : a) {
        const auto r = std::ranges::find(b, l.key, &Streak::key);
        if (r == b.end() || l.start.z < 0.3f) continue;
        ++pairs;
        const double shift = double(left.pixel_from_view(l.start).x) - double(right.pixel_from_view(r->start).x);
        CHECK(shift == doctest::Approx(focal * baseline / double(l.start.z)).epsilon(1e-3).scale(0));
    }
    CHECK(pairs > 20);

    // On the pictures: the nearest wide streak of the left one is found by its disparity on the right one.
    const PictureSource wall{Image<Rgb>(128, 64, Rgb(1)), Image<float>(128, 64, 2)};
    RenderSettings settings = rainy(4);
    settings.rain.min_width_pixels = 0.25;
    const Picture p = augment_picture(wall, left, settings), q = augment_picture(wall, right, settings);
    int seen = 0, found = 0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 128; ++x) {
            const float z = p.plane("rainy_Z_100")[size_t(y) * 128 + size_t(x)];
            const int there = int(std::floor(x + 0.5 - focal * baseline / double(z)));
            if (!(z < 1.9f) || there < 1 || there > 126) continue;
            ++seen;
            for (int dx : {-1, 0, 1}) {
                const float other = q.plane("rainy_Z_100")[size_t(y) * 128 + size_t(there + dx)];
                if (std::abs(other - z) < 0.02f * z) {
                    ++found;
                    break;
                }
            }
        }
    CHECK(seen > 20);
    // A nearer drop may hide it from the other camera.
    CHECK(found >= 0.9 * seen);
}

}  // namespace pluvia
