// `pluvia augment` as a user runs it: layouts, depth, what goes wrong and what goes on.
#include "renderer/image/depth_encoding.h"
#include "renderer/image/exposure.h"
#include "renderer/image/exr.h"
#include "renderer/image/image_io.h"
#include "tests/dataset_fixture.h"
#include "tests/error_of.h"
#include "tests/street_pictures.h"
#include "tools/augment/augment_items.h"
#include "tools/augment/npy_file.h"
#include "tools/augment/picture_exposure.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>

namespace pluvia {
namespace {

namespace fs = std::filesystem;

/// Pictures 64 x 32 named a, b, c in rgb/, with depth in depth/.
struct SmallFolder {
    SmallFolder() {
        for (const char* name : {"a", "b", "c"}) {
            write_rgb(folder / ("in/rgb/" + std::string(name) + ".png"), 64, 32, street);
            write_grey16(folder / ("in/depth/" + std::string(name) + ".png"), 64, 32, street_depth);
        }
    }
    Outcome run(const std::string& output, const std::string& more = "") const {
        return run_program("augment " + (folder / "in") + " -o " + (folder / output) +
                           " --images 'rgb/*.png' --depth 'depth/*.png' --depth-encoding kitti16 --fov 20 --rain 100 "
                           "--spp 2 --progress none " +
                           more);
    }
    nlohmann::json record(const std::string& output, const std::string& name) const {
        return nlohmann::json::parse(read_file(folder / (output + "/records/" + name + ".json")));
    }
    TemporaryFolder folder;
};

}  // namespace

TEST_CASE("augment puts rain on a folder of pictures and says what it filled in") {
    const SmallFolder set;
    write_grey16(set.folder / "in/depth/b.png", 64, 32,
                 [](int x, int y) { return x == 5 && y == 20 ? uint16_t(0) : street_depth(x, y); });
    const Outcome outcome = set.run("out", "--exr");
    CAPTURE(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    for (const char* kind : {"rainy", "rain_layer", "rain_mask", "transmittance", "inscatter"})
        for (const char* name : {"a", "b", "c"})
            CHECK(fs::exists(set.folder / fmt::format("out/{}_100/{}.png", kind, name)));
    const auto depth = set.record("out", "b")["depth"];
    CHECK(depth["filled_pixels"] == 1);
    CHECK(depth["sky_pixels"] == 12 * 64);
    CHECK(depth["assumed_sky_pixels"] == 12 * 64);
    // Each picture has drops of its own.
    CHECK(read_file(set.folder / "out/rain_layer_100/a.png") != read_file(set.folder / "out/rain_layer_100/c.png"));

    ExrReader exr(set.folder / "out/layers/a.exr");
    std::vector<float> background(64 * 32), transmittance(64 * 32), rainy(64 * 32), rain(64 * 32), veil(64 * 32);
    const std::vector<ExrRequest> requests = {{"background.G", background.data()},
                                              {"transmittance_100.G", transmittance.data()},
                                              {"rainy_100.G", rainy.data()},
                                              {"rain_100.G", rain.data()},
                                              {"inscatter_100.G", veil.data()}};
    exr.read_rows(0, 32, requests);
    for (size_t i = 0; i < rainy.size(); ++i)
        CHECK(rainy[i] == doctest::Approx(background[i] * transmittance[i] + rain[i] + veil[i]).epsilon(1e-5).scale(0));
}

TEST_CASE("augment goes on after a stop, keeps what is done and makes the same bytes in parts") {
    const SmallFolder set;
    REQUIRE(set.run("whole").exit_code == 0);
    REQUIRE(set.run("parts", "--shard 2/3").exit_code == 0);
    CHECK(fs::exists(set.folder / "parts/rainy_100/b.png"));
    CHECK(!fs::exists(set.folder / "parts/rainy_100/a.png"));
    write_file(set.folder / "parts/rainy_100/b.png", "damaged");
    const Outcome again = set.run("parts", "--json --threads 1");
    CHECK(nlohmann::json::parse(again.out)["made"] == 3);
    CHECK(nlohmann::json::parse(set.run("parts", "--json").out)["already_done"] == 3);
    CHECK(difference(product_files(set.folder / "whole"), product_files(set.folder / "parts")) == "");
    // Another setting is another picture.
    CHECK(nlohmann::json::parse(set.run("parts", "--json --seed 5").out)["made"] == 3);
}

TEST_CASE("augment names damaged, missing and mismatched files, makes the rest and exits with 5") {
    const SmallFolder set;
    const std::string whole = read_file(set.folder / "in/rgb/a.png");
    write_file(set.folder / "in/rgb/a.png", whole.substr(0, whole.size() / 2));
    fs::remove(set.folder / "in/depth/b.png");
    write_rgb(set.folder / "in/rgb/d.png", 64, 32, street);
    write_grey16(set.folder / "in/depth/d.png", 32, 32, street_depth);
    write_rgb(set.folder / "in/rgb/e.png", 64, 32, street);
    write_rgb(set.folder / "in/depth/e.png", 64, 32, street);  // 8 bits
    write_rgb(set.folder / "in/rgb/f.png", 64, 32, street);
    write_grey16(set.folder / "in/depth/f.png", 64, 32, [](int, int) { return uint16_t(0); });
    const Outcome outcome = set.run("out");
    CAPTURE(outcome.err);
    CHECK(outcome.exit_code == 5);
    for (const char* part :
         {"in/rgb/a.png: ", "in/depth/b.png: ", "in/depth/d.png: is of another size than",
          "in/depth/e.png: is no depth of this encoding (got 8 bits", "in/depth/f.png: has no depth"})
        CHECK(outcome.err.find(part) != std::string::npos);
    CHECK(fs::exists(set.folder / "out/rainy_100/c.png"));
    CHECK(!fs::exists(set.folder / "out/rainy_100/d.png"));
    CHECK(!fs::exists(set.folder / "out/work"));

    fs::remove(set.folder / "in/rgb/c.png");
    CHECK(set.run("none").exit_code == 3);
    fs::remove_all(set.folder / "in/rgb");
    const Outcome empty = set.run("empty");
    CHECK(empty.exit_code == 3);
    CHECK(empty.err.find("holds no picture in the layout folder") != std::string::npos);
}

TEST_CASE("augment --delta-only writes nothing that shows the input") {
    const SmallFolder set;
    REQUIRE(set.run("out", "--delta-only").exit_code == 0);
    CHECK(!fs::exists(set.folder / "out/rainy_100"));
    const ExrReader exr(set.folder / "out/layers/a.exr");
    for (const ExrChannel& channel : exr.channels()) {
        CAPTURE(channel.name);
        CHECK((channel.name.starts_with("transmittance_") || channel.name.starts_with("rain_") ||
               channel.name.starts_with("inscatter_")));
    }
}

TEST_CASE("augment copies labels unchanged") {
    const SmallFolder set;
    for (const char* name : {"a", "b", "c"}) {
        fs::create_directories(set.folder / "in/ids");
        write_file(set.folder / ("in/ids/" + std::string(name) + ".txt"), "label " + std::string(name));
    }
    REQUIRE(set.run("out", "--labels 'ids/*.txt'").exit_code == 0);
    CHECK(read_file(set.folder / "out/ids/b.txt") == "label b");
}

TEST_CASE("augment refuses options that do not fit together before it reads pictures") {
    const SmallFolder set;
    const std::string in = "augment " + (set.folder / "in") + " -o " + (set.folder / "out");
    for (const char* wrong : {"--rain 10", "--images 'rgb/*.png' --rain 10", "--dataset moon --rain 10",
                              "--images 'rgb/*.png' --depth 'depth/x.png' --depth-encoding mm16 --rain 10",
                              "--images 'rgb/*.png' --depth 'depth/*.png' --depth-encoding mm17 --rain 10",
                              "--images 'rgb/*.png' --depth 'depth/*.png' --depth-encoding mm16",
                              "--images 'rgb/*.png' --depth 'depth/*.png' --depth-encoding mm16 --rain 10",
                              "--dataset kitti --images 'rgb/*.png' --rain 10", "--rain 10 --curve log"}) {
        CAPTURE(wrong);
        const Outcome outcome = run_program(in + " " + wrong);
        CAPTURE(outcome.err);
        CHECK(outcome.exit_code == 2);
    }
}

TEST_CASE("depth is read in every encoding") {
    const TemporaryFolder folder;
    const float infinity = std::numeric_limits<float>::infinity();
    const auto depth_at = [&](const std::string& file, DepthFormat format) {
        return read_depth(folder / file, format).at(1, 0);
    };
    write_grey16(folder / "d.png", 2, 1, [](int, int) { return uint16_t(2561); });
    CHECK(depth_at("d.png", {DepthInput::kitti16}) == doctest::Approx(2561 / 256.0));
    CHECK(depth_at("d.png", {DepthInput::mm16}) == doctest::Approx(2.561));
    CHECK(depth_at("d.png", {DepthInput::disparity, 500}) == doctest::Approx(50));
    const Rgba8 code = encode_carla24(123.4f);
    write_rgb(folder / "c.png", 2, 1, [&](int, int) { return code; });
    CHECK(depth_at("c.png", {DepthInput::carla24}) == doctest::Approx(123.4).epsilon(1e-5));
    CHECK(depth_at("c.png", {DepthInput::carla}) == doctest::Approx(123.4).epsilon(1e-5));
    // CARLA: value = 1 + ln(z / 1000 m) / 5.70378.
    const auto grey = uint8_t(std::lround(255 * (1 + std::log(0.02) / 5.70378)));
    write_rgb(folder / "l.png", 2, 1, [&](int, int) { return Rgba8{grey, grey, grey, 255}; });
    CHECK(depth_at("l.png", {DepthInput::carla}) == doctest::Approx(20).epsilon(0.012));
    write_rgb(folder / "s.png", 2, 1, [&](int, int) { return Rgba8{255, 255, 255, 255}; });
    CHECK(depth_at("s.png", {DepthInput::carla_log}) == infinity);
    const std::vector<float> metres = {1, 17};
    {
        ExrWriter exr(folder / "z.exr", 2, 1, {{"Z", false}});
        const ExrRows rows = metres.data();
        exr.write_rows(0, 1, {&rows, 1});
        exr.finish();
    }
    CHECK(depth_at("z.exr", {DepthInput::metres}) == 17);
    std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (1, 2), }\n";
    std::string bytes("\x93NUMPY\x01\x00", 8);
    bytes += char(header.size());
    bytes += '\0';
    bytes += header + std::string(reinterpret_cast<const char*>(metres.data()), 8);
    write_file(folder / "z.npy", bytes);
    CHECK(depth_at("z.npy", {DepthInput::metres}) == 17);
    write_file(folder / "short.npy", bytes.substr(0, bytes.size() - 1));
    CHECK(error_of([&] { read_npy(folder / "short.npy"); }).code() == ExitCode::input);
    write_file(folder / "other.npy", "no array");
    CHECK(error_of([&] { read_npy(folder / "other.npy"); }).code() == ExitCode::input);
}

TEST_CASE("unknown depth is that of the nearest known pixel, and sky where it is open to the top of dense depth") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    Image<float> sparse(20, 10, nan);
    sparse.at(3, 2) = 5, sparse.at(16, 7) = 50;
    const DepthFilling a = fill_depth(sparse, "sparse");
    CHECK(a.filled == 198);
    CHECK(a.sky == 0);
    for (int y = 0; y < 10; ++y)
        for (int x = 0; x < 20; ++x) {
            const double near = std::hypot(x - 3, y - 2), far = std::hypot(x - 16, y - 7);
            if (std::abs(near - far) > 1) CHECK(sparse.at(x, y) == (near < far ? 5 : 50));
        }
    Image<float> dense(20, 10, 8);
    for (int x = 0; x < 20; ++x) dense.at(x, 0) = nan;
    dense.at(4, 1) = nan, dense.at(9, 5) = nan;
    const DepthFilling b = fill_depth(dense, "dense");
    CHECK(b.filled == 1);
    CHECK(b.assumed_sky == 21);
    CHECK(std::isinf(dense.at(4, 1)));
    CHECK(dense.at(9, 5) == 8);
    Image<float> none(4, 4, nan);
    CHECK(error_of([&] { fill_depth(none, "none"); }).code() == ExitCode::input);
}

TEST_CASE("exposure is estimated: a day's sky has 4000 cd/m2, a night's street 1, and what is given wins") {
    Image<float> z(20, 10, 8);
    for (int x = 0; x < 20; ++x)
        for (int y = 0; y < 3; ++y) z.at(x, y) = std::numeric_limits<float>::infinity();
    Image<Rgb> picture(20, 10, Rgb(0.1f));
    const auto luminance_of_white = [](const ExposureEstimate& e) { return 1 / double(exposure_scale(e.ev100)); };
    for (int x = 0; x < 20; ++x)
        for (int y = 0; y < 3; ++y) picture.at(x, y) = Rgb(0.5f);
    const ExposureEstimate day = estimate_exposure(picture, z);
    CHECK(day.by == "sky by day");
    CHECK(0.5 * luminance_of_white(day) == doctest::Approx(4000).epsilon(1e-4));
    for (int x = 0; x < 20; ++x)
        for (int y = 0; y < 3; ++y) picture.at(x, y) = Rgb(0.01f);
    const ExposureEstimate night = estimate_exposure(picture, z);
    CHECK(night.by == "surfaces by night");
    CHECK(0.1 * luminance_of_white(night) == doctest::Approx(1).epsilon(1e-4));
    const Image<float> wall(20, 10, 8);
    CHECK(estimate_exposure(Image<Rgb>(20, 10, Rgb(0.2f)), wall).by == "surfaces by day");
    CHECK(estimate_exposure(Image<Rgb>(20, 10, Rgb(0.02f)), wall).by == "surfaces by night");
    CHECK(estimate_exposure(Image<Rgb>(20, 10, Rgb(0)), wall).ev100 == 12);

    const SmallFolder set;
    REQUIRE(set.run("guessed").exit_code == 0);
    REQUIRE(set.run("given", "--exposure 11.5").exit_code == 0);
    CHECK(set.record("guessed", "a")["exposure_from"] == "sky by day");
    CHECK(set.record("given", "a")["exposure_from"] == "given");
    CHECK(set.record("given", "a")["exposure_ev100"] == 11.5);
}

TEST_CASE("a frame of pluvia render is augmented by its own frame.json with its own coverage") {
    const SmallDataset scene;
    const std::string out = scene.folder / "frame";
    const std::string rain = "--rain 100 --composition physical --spp 4 --progress none --environment 80,90,100 ";
    REQUIRE(run_program("render " + (scene.folder / "court.glb") + " --camera eye --size 64x32 " + rain + "-o " + out)
                .exit_code == 0);
    const Outcome outcome = run_program("augment " + out + " --images frame.exr --depth frame.exr --calibration " +
                                        out + "/frame.json --exr -o " + (scene.folder / "again") + " " + rain);
    CAPTURE(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    std::vector<float> rendered(64 * 32), augmented(64 * 32);
    const auto read = [](const std::string& path, std::vector<float>& plane) {
        const ExrRequest request{"rain_100.A", plane.data()};
        ExrReader(path).read_rows(0, 32, {&request, 1});
    };
    read(out + "/frame.exr", rendered);
    read(scene.folder / "again/layers/frame.exr", augmented);
    double total = 0;
    int different = 0;
    for (size_t i = 0; i < rendered.size(); ++i) {
        total += double(rendered[i]);
        different += rendered[i] != doctest::Approx(augmented[i]).epsilon(1e-4).scale(1e-20);
    }
    CHECK(total > 0);
    // Depth inside of a pixel is that of its centre: where a drop is close to an edge of the box it may be hidden or
    // not.
    CHECK(different <= 4);
}

}  // namespace pluvia
