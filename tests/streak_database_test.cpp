// The streak database: what is traced into it, its files, and how streaks look by it.
#include "renderer/core/error.h"
#include "shaders/drop_trace.h"
#include "shaders/streak_files.h"
#include "shaders/streak_textures.h"
#include "shaders/streak_tracing.h"
#include "tests/run_program.h"
#include "tests/statistics.h"
#include "tools/streak_cache.h"

#include <doctest/doctest.h>

#include <cmath>

namespace pluvia {
namespace {

/// Random pictures of a few pixels; lights behind the drop and, seen from above, below it are the brightest.
StreakDatabase small_database(int width = 4, int height = 12) {
    StreakDatabase database;
    for (size_t v = 0; v < database.views.size(); ++v) {
        StreakDatabase::View& view = database.views[v];
        view.width = width, view.height = height - int(v);
        for (int i = 0; i < streak_light_count * streak_oscillations + streak_oscillations; ++i) {
            const Vec3 light = streak_light(std::min(i / streak_oscillations, streak_light_count - 1)).direction();
            std::vector<float> values(size_t(view.width * view.height));
            for (size_t k = 0; k < values.size(); ++k)
                values[k] = (0.1f + uniform(3, v * 10000 + size_t(i), k)) * (2 - light.z) * (2 - light.y);
            const StreakPicture picture = picture_from(values);
            if (i < streak_light_count * streak_oscillations)
                view.pictures.push_back(picture);
            else
                view.ambient[size_t(i - streak_light_count * streak_oscillations)] = picture;
        }
    }
    return database;
}

void ignore_progress(double) {}

std::string error_of(const std::string& folder) {
    try {
        read_streaks(folder);
    } catch (const Error& error) {
        CHECK(error.code() == ExitCode::input);
        return error.what();
    }
    return {};
}

}  // namespace

TEST_CASE("the light nearest to a light's direction is that light, and its mirror image is told apart") {
    for (int i = 0; i < streak_light_count; ++i) {
        CAPTURE(i);
        bool mirrored = true;
        const Vec3 d = streak_light(i).direction();
        CHECK(nearest_streak_light(d, &mirrored) == i);
        CHECK(!mirrored);
        if (streak_light(i).on_axis()) continue;
        CHECK(nearest_streak_light({-d.x, d.y, d.z}, &mirrored) == i);
        CHECK(mirrored);
    }
}

TEST_CASE("streaks under the light on the axis and in the mean over all lights agree with a direct trace") {
    StreakTracing settings;
    settings.width = 4;
    settings.rays_per_pixel = 300;
    settings.light_radius = 0.3f;  // large, so that chance decides little
    const StreakDatabase database = trace_streaks(settings, ignore_progress);
    const double solid_angle = 2 * 3.14159265358979 * (1 - std::cos(0.3));

    // Level rays through the disk at random moments, with random numbers of another kind.
    constexpr int view = 0, oscillation = 3;
    const DropOscillation drop = streak_oscillation(0, oscillation);
    RunningMean on_axis, all;
    for (uint64_t i = 0; i < 600000; ++i) {
        const float u = 2 * uniform(8, i, 0) - 1, w = 2 * uniform(8, i, 1) - 1;
        double axis = 0, sum = 0;
        const Vec3 origin(u * drop.rest.half_width, w * drop.rest.half_height, 0);
        for (const DropExit& exit : trace_drop(drop.at(uniform(8, i, 2) * streak_exposure), origin, {0, 0, -1}).all())
            for (int light = 0; light < streak_light_count; ++light)
                if (dot(exit.direction, streak_light(light).direction()) > std::cos(0.3f)) {
                    sum += exit.weight;
                    if (light == streak_light_count - 1) axis += exit.weight;
                }
        on_axis.add(axis / solid_angle);
        all.add(sum / (solid_angle * streak_light_count));
    }
    // The mean over the square around the silhouette of what covers the pixel, times its share of the picture's height:
    // a streak is as long as the path and one drop, and a drop's disk sweeps the path.
    const StreakDatabase::View& v = database.views[view];
    const auto mean_of = [&](int light) {
        const StreakPicture& picture = v.picture(light, oscillation);
        double sum = 0;
        for (const uint16_t value : picture.values) sum += value;
        const double path = 5.2 * streak_exposure / (streak_diameter / 2) * 4 / (2 * double(drop.rest.half_width));
        return sum / 65535 * picture.factor / (4 * path);
    };
    double mean = 0;
    for (int light = 0; light < streak_light_count; ++light) mean += mean_of(light) / streak_light_count;
    CAPTURE(on_axis.mean());
    CAPTURE(on_axis.standard_error());
    // 2 % as required of the database; the direct trace itself is known to 0.4 % on the axis.
    CHECK(std::abs(mean_of(streak_light_count - 1) / on_axis.mean() - 1) <
          0.02 + 5 * on_axis.standard_error() / on_axis.mean());
    CHECK(std::abs(mean / all.mean() - 1) < 0.02);
    CHECK(on_axis.standard_error() < 0.01 * on_axis.mean());
}

TEST_CASE("streaks are brightest with the light behind the drop, and every picture lies within 16 bits") {
    StreakTracing settings;
    settings.width = 4;
    settings.rays_per_pixel = 20;
    const StreakDatabase database = trace_streaks(settings, ignore_progress);
    const auto sum_of = [&](Vec3 direction) {
        double sum = 0;
        for (int k = 0; k < streak_oscillations; ++k) {
            const StreakPicture& picture = database.views[0].picture(nearest_streak_light(direction), k);
            for (const uint16_t value : picture.values) sum += value * double(picture.factor) / 65535;
        }
        return sum;
    };
    const double behind = sum_of(normalize(Vec3(0.17f, 0.17f, -1))), beside = sum_of(normalize(Vec3(1, 0.17f, 0)));
    CAPTURE(behind / beside);
    CHECK(behind > 50 * beside);  // 1.0 and 0.002 per steradian by the phase function; lights are wide
    for (const auto& view : database.views)
        for (const StreakPicture& picture : view.pictures)
            if (picture.factor > 0) CHECK(*std::max_element(picture.values.begin(), picture.values.end()) == 65535);
}

TEST_CASE("files of a streak database read back identical") {
    const TemporaryFolder folder;
    const StreakDatabase database = small_database();
    write_streaks(folder / "streaks", {database, narrowed(database, 1)}, ignore_progress);
    CHECK(read_streaks(folder / "streaks") == database);
    CHECK(read_streaks(folder / "streaks", 4) == database);
    CHECK(std::filesystem::exists(folder / "streaks/point_light_database/size4/dcam20/cv20_v-10_h30_osc9.png"));
    CHECK(std::filesystem::exists(folder / "streaks/point_light_database/size4/dcam00/cv0_v90_h170_osc0.png"));
    CHECK(!std::filesystem::exists(folder / "streaks/point_light_database/size4/dcam00/cv0_v90_h10_osc0.png"));
    CHECK(std::filesystem::exists(folder / "streaks/env_light_database/size4/cv80_osc0.png"));
    CHECK_THROWS_AS(write_streaks(folder / "streaks", {database}, ignore_progress), Error);
}

TEST_CASE("a database whose azimuths and elevations run the other way is turned to have the light behind") {
    const TemporaryFolder folder;
    const StreakDatabase database = small_database();
    StreakDatabase turned = database;
    for (StreakDatabase::View& view : turned.views)
        for (int i = 0; i < streak_light_count; ++i) {
            const Vec3 d = streak_light(i).direction();
            for (int k = 0; k < streak_oscillations; ++k)
                view.pictures[size_t(nearest_streak_light({d.x, -d.y, -d.z}) * streak_oscillations + k)] =
                    database.views[size_t(&view - turned.views.data())].picture(i, k);
        }
    write_streaks(folder / "streaks", {turned}, ignore_progress);
    CHECK(read_streaks(folder / "streaks") == database);
}

TEST_CASE("a missing or truncated file of a streak database is an error with its name and exit code 3") {
    const TemporaryFolder folder;
    const std::string root = folder / "streaks";
    write_streaks(root, {small_database()}, ignore_progress);
    const auto spoil = [&](const std::string& name, size_t keep) {
        const std::string path = root + "/" + name, bytes = read_file(path);
        keep == 0 ? (void)std::filesystem::remove(path) : write_file(path, bytes.substr(0, keep));
        const std::string message = error_of(root);
        CAPTURE(message);
        CHECK(message.find(name) != std::string::npos);
        write_file(path, bytes);
    };
    spoil("point_light_database/size4/dcam40/cv40_v30_h90_osc5.png", 0);
    spoil("point_light_database/size4/dcam40/cv40_v30_h90_osc5.png", 70);
    spoil("env_light_database/size4/cv20_osc1.png", 0);
    spoil("env_light_database/txt/normalized_env_max.txt", 40);
    spoil("point_light_database/txt/dcam60_point_max.txt", 0);
    spoil("point_light_database/txt/dcam60_point_max.txt", 3000);
    CHECK(error_of(root).empty());

    std::filesystem::remove(root + "/point_light_database/size4/dcam00/cv0_v-90_h170_osc0.png");
    const Outcome outcome = run_program("streaks show " + root + " -o " + (folder / "sheet.png"));
    CHECK(outcome.exit_code == 3);
    CHECK(outcome.err.find("cv0_v-90_h170_osc0.png") != std::string::npos);
}

TEST_CASE("a picture at half the width holds the same light") {
    const StreakDatabase database = small_database();
    const StreakDatabase half = narrowed(database, 2);
    for (size_t v = 0; v < 5; v += 2) {  // even heights
        const StreakPicture &a = database.views[v].picture(9, 3), &b = half.views[v].picture(9, 3);
        double sum = 0, half_sum = 0;
        for (const uint16_t value : a.values) sum += value;
        for (const uint16_t value : b.values) half_sum += 4.0 * value;
        CHECK(b.factor == a.factor);
        CHECK(std::abs(half_sum / sum - 1) < 1e-4);  // rounding to 16 bits
    }
}

TEST_CASE("a damaged file of the cache is traced anew") {
    const TemporaryFolder folder;
    StreakTracing settings;
    settings.width = 4;
    settings.rays_per_pixel = 2;
    const StreakDatabase traced = cached_streaks(settings, Progress::Style::none, folder.path());
    const std::string path = std::filesystem::directory_iterator(folder.path())->path();
    const std::string bytes = read_file(path);
    CHECK(cached_streaks(settings, Progress::Style::none, folder.path()) == traced);
    write_file(path, bytes.substr(0, bytes.size() / 2));
    CHECK(cached_streaks(settings, Progress::Style::none, folder.path()) == traced);
    CHECK(read_file(path) == bytes);
}

TEST_CASE("the brightness of a streak under each light is one in the mean over what the drop covers") {
    const StreakTextures textures(small_database(8, 96));
    for (const Vec3 wi : {Vec3(0, 1, 0), normalize(Vec3(-1, 0.3f, 0.2f)), normalize(Vec3(0.1f, -0.2f, -1))})
        for (const Vec3 direction : {Vec3(0, 0, -1), normalize(Vec3(1, 1, 0)), normalize(Vec3(0.1f, -1, 0))}) {
            RunningMean mean;
            for (uint64_t i = 0; i < 200000; ++i) {
                const float across = 2 * uniform(4, i, 0) - 1;
                const StreakPlace place =
                    streak_place(direction, 17, streak_diameter, streak_exposure, across, uniform(4, i, 1));
                mean.add(std::sqrt(1 - across * across) * textures.brightness(place, wi) / 0.785398);
            }
            CAPTURE(mean.mean());
            // Interpolation between the random pixels of the picture moves some of the light.
            CHECK(std::abs(mean.mean() - 1) < 0.05);
        }
}

TEST_CASE("a light on the other side mirrors the streak") {
    const StreakTextures textures(small_database());
    const Vec3 direction(0, 0, -1), wi = normalize(Vec3(0.5f, 0.2f, -0.7f));
    for (const float across : {-0.8f, 0.1f, 0.6f}) {
        const auto at = [&](float u) { return streak_place(direction, 17, streak_diameter, streak_exposure, u, 0.4f); };
        CHECK(textures.brightness(at(across), wi) == textures.brightness(at(-across), {-wi.x, wi.y, wi.z}));
    }
}

}  // namespace pluvia
