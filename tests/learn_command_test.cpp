// `pluvia learn` as a user runs it; what needs libtorch is skipped where the build has none.
#include "renderer/image/image_io.h"
#include "tests/run_program.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <cmath>

using namespace pluvia;

namespace {

bool has_libtorch() {
    return std::filesystem::exists(std::filesystem::path(PLUVIA_PROGRAM).parent_path() / "pluvia_learn");
}

void write_grey(const std::string& path, int width, int height, uint8_t value) {
    PngWriter writer(path, width, height, 1, 8);
    const std::vector<uint8_t> bytes(size_t(width) * size_t(height), value);
    writer.write_rows(0, height, bytes.data());
    writer.finish();
}

}  // namespace

TEST_CASE("without libtorch training and inference say in one line how to get it") {
    if (has_libtorch()) {
        MESSAGE("libtorch is there: nothing to see");
        return;
    }
    for (const char* command :
         {"learn train", "learn crig --model a -o b", "learn evaluate --prediction a --truth b --lpips c",
          "learn infer --background a --mask b --model c -o d"}) {
        const Outcome o = run_program(command);
        CHECK(o.exit_code == 2);
        CHECK(o.err.find("apt-get install libtorch-dev") != std::string::npos);
        CHECK(std::count(o.err.begin(), o.err.end(), '\n') == 1);
    }
}

TEST_CASE("train and infer pass options, help and exit codes on") {
    if (!has_libtorch()) {
        MESSAGE("skipped: libtorch is missing");
        return;
    }
    const Outcome help = run_program("learn infer --help");
    CHECK(help.exit_code == 0);
    CHECK(help.out.find("--tiling") != std::string::npos);
    CHECK(run_program("learn infer").exit_code == 2);
    CHECK(run_program("learn train -o nowhere").exit_code == 2);
    CHECK(run_program("learn infer --background /nonexistent --mask a --model b -o c").exit_code == 3);
}

TEST_CASE("info refuses what is no model with exit code 3") {
    const std::string corpus = std::string(PLUVIA_SOURCE_DIR) + "/tests/fuzz/safetensors/";
    CHECK(run_program("learn info " + corpus + "refused_overlap.safetensors").exit_code == 3);
    CHECK(run_program("learn info " + corpus + "floats.safetensors").exit_code == 3);
    CHECK(run_program("learn info /nonexistent").exit_code == 3);
}

TEST_CASE("the model that comes with Pluvia is taken where none is named") {
    const Outcome info = run_program("learn info");
    REQUIRE(info.exit_code == 0);
    CHECK(info.out.find("training") != std::string::npos);
    if (!has_libtorch()) {
        MESSAGE("inference skipped: libtorch is missing");
        return;
    }
    const TemporaryFolder folder;
    write_grey(folder / "clean.png", 64, 32, 60);
    write_grey(folder / "mask.png", 64, 32, 8);
    const Outcome o = run_program("learn infer --progress none --background " + (folder / "clean.png") + " --mask " +
                                  (folder / "mask.png") + " -o " + (folder / "out"));
    REQUIRE(o.exit_code == 0);
    CHECK(read_rgba8(folder / "out/clean.png").width == 64);  // as the clean picture: one mask may serve many
}

TEST_CASE("evaluate finds the PSNR of a known difference, overall and in the rain") {
    const TemporaryFolder folder;
    write_grey(folder / "truth.png", 32, 16, 100);
    write_grey(folder / "prediction.png", 32, 16, 110);
    write_grey(folder / "mask.png", 32, 16, 255);
    const std::string files = "--prediction " + (folder / "prediction.png") + " --truth " + (folder / "truth.png");
    const Outcome o = run_program("learn evaluate --json " + files + " --mask " + (folder / "mask.png"));
    REQUIRE(o.exit_code == 0);
    const auto mean = nlohmann::json::parse(o.out)["mean"];
    const double expected = 20 * std::log10(25.5);
    CHECK(mean["psnr_db"].get<double>() == doctest::Approx(expected).epsilon(1e-4).scale(0));
    CHECK(mean["rain_psnr_db"].get<double>() == doctest::Approx(expected).epsilon(1e-4).scale(0));
    write_grey(folder / "small.png", 16, 16, 100);
    CHECK(run_program("learn evaluate --prediction " + (folder / "small.png") + " --truth " + (folder / "truth.png"))
              .exit_code == 3);
}

TEST_CASE("masks from mm/h are layers with alpha, more of it the more it rains, and are kept") {
    const TemporaryFolder folder;
    const std::string command =
        "learn mask --rain 10,100 --size 256x128 --spp 4 --progress none -o " + (folder / "masks");
    REQUIRE(run_program(command).exit_code == 0);
    const auto covered = [&](const std::string& name) {
        const Image<Rgba8> layer = read_rgba8(folder / ("masks/" + name));
        return std::count_if(layer.pixels.begin(), layer.pixels.end(), [](const Rgba8& p) { return p.a >= 3; });
    };
    const auto light = covered("010mm_frame_0000.png"), heavy = covered("100mm_frame_0000.png");
    CAPTURE(light);
    CAPTURE(heavy);
    CHECK(light > 50);
    CHECK(heavy > 2 * light);
    CHECK(heavy < 256 * 128);
    for (const Rgba8& p : read_rgba8(folder / "masks/100mm_frame_0000.png").pixels)
        REQUIRE((p.r == p.a && p.g == p.a && p.b == p.a));  // one picture for readers of alpha and of colour
    const auto labels = nlohmann::json::parse(read_file(folder / "masks/data_info.json"));
    REQUIRE(labels.size() == 2);
    CHECK(labels[1]["img"] == "100mm_frame_0000.png");
    CHECK(labels[1]["label"] == nlohmann::json({1.0, 0.0}));
    const Outcome again = run_program(command);
    CHECK(again.out.find("2 of them were there already") != std::string::npos);
    CHECK(run_program("learn mask --rain -1 -o " + (folder / "no")).exit_code == 2);
}
