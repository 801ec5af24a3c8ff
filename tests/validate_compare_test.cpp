// pluvia validate compare as users meet it: files of other programs, folders, limits, messages.
#include "renderer/core/error.h"
#include "renderer/image/exr.h"
#include "renderer/image/image_io.h"
#include "tests/run_program.h"
#include "tests/statistics.h"
#include "tools/validate/exr_layers.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <limits>

namespace pluvia {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

constexpr int width = 24, height = 16;

/// Every channel holds noise of its own seed, times scale.
void write_exr(const std::string& path, const std::vector<std::string>& names, float scale = 1) {
    std::vector<ExrChannel> channels;
    for (const std::string& name : names) channels.push_back({name, false});
    ExrWriter writer(path, width, height, channels);
    std::vector<std::vector<float>> planes;
    std::vector<ExrRows> rows;
    for (size_t c = 0; c < names.size(); ++c) {
        std::vector<float> plane;
        for (uint64_t i = 0; i < width * height; ++i) plane.push_back(scale * (0.5f + uniform(c, i, 0)));
        planes.push_back(plane);
    }
    for (const auto& plane : planes) rows.emplace_back(plane.data());
    writer.write_rows(0, height, rows);
    writer.finish();
}

void write_png(const std::string& path, int bits, int value, int channels = 3) {
    PngWriter writer(path, width, height, channels, bits);
    const size_t size = size_t(width * height * channels);
    if (bits == 8)
        writer.write_rows(0, height, std::vector<uint8_t>(size, uint8_t(value)).data());
    else
        writer.write_rows(0, height, std::vector<uint16_t>(size, uint16_t(value)).data());
    writer.finish();
}

std::vector<std::string> found(const std::vector<std::string>& names, const std::string& layer) {
    std::vector<ExrChannel> channels;
    for (const std::string& name : names) channels.push_back({name, false});
    return find_layer(channels, layer, "file").channels;
}
using Names = std::vector<std::string>;

Json measured(const std::string& arguments) {
    const Outcome done = run_program("validate compare --json " + arguments);
    CAPTURE(done.err);
    REQUIRE(done.exit_code == 0);
    return Json::parse(done.out);
}

}  // namespace

TEST_CASE("the picture and its depth are found under the names that each renderer gives them") {
    const Names pluvia = {"Z",          "background.B", "background.G", "background.R", "distance.Y",
                          "rain_100.A", "rain_100.B",   "rain_100.G",   "rain_100.R",   "rainy_Z_100"};
    CHECK(found(pluvia, "") == Names{"background.R", "background.G", "background.B"});
    CHECK(found(pluvia, "rain_100") == Names{"rain_100.R", "rain_100.G", "rain_100.B"});
    CHECK(found(pluvia, "rain_100.A") == Names{"rain_100.A"});
    CHECK(found(pluvia, "depth") == Names{"Z"});
    CHECK(found(pluvia, "distance") == Names{"distance.Y"});
    const Names cycles = {"Composite.Combined.B", "Composite.Combined.G", "Composite.Combined.R",
                          "ViewLayer.Combined.A", "ViewLayer.Combined.B", "ViewLayer.Combined.G",
                          "ViewLayer.Combined.R", "ViewLayer.Depth.Z",    "ViewLayer.Normal.X",
                          "ViewLayer.Normal.Y",   "ViewLayer.Normal.Z"};
    CHECK(found(cycles, "") == Names{"ViewLayer.Combined.R", "ViewLayer.Combined.G", "ViewLayer.Combined.B"});
    CHECK(found(cycles, "Combined") == found(cycles, ""));
    CHECK(found(cycles, "Composite.Combined")[0] == "Composite.Combined.R");
    CHECK(found(cycles, "Normal") == Names{"ViewLayer.Normal.X", "ViewLayer.Normal.Y", "ViewLayer.Normal.Z"});
    CHECK(found(cycles, "depth") == Names{"ViewLayer.Depth.Z"});
    const Names mitsuba = {"<root>.B", "<root>.G", "<root>.R", "dd.T", "sh.X", "sh.Y", "sh.Z"};
    CHECK(found(mitsuba, "") == Names{"<root>.R", "<root>.G", "<root>.B"});
    CHECK(found(mitsuba, "distance") == Names{"dd.T"});
    CHECK(found({"B", "G", "R", "dd.T"}, "") == Names{"R", "G", "B"});
    const Names pbrt = {"Albedo.B",   "Albedo.G",   "Albedo.R",   "B",   "G",   "N.X",
                        "N.Y",        "N.Z",        "P.X",        "P.Y", "P.Z", "R",
                        "Variance.B", "Variance.G", "Variance.R", "u",   "v"};
    CHECK(found(pbrt, "") == Names{"R", "G", "B"});
    CHECK(found(pbrt, "Albedo") == Names{"Albedo.R", "Albedo.G", "Albedo.B"});
    CHECK(found(pbrt, "P") == Names{"P.X", "P.Y", "P.Z"});
    CHECK_THROWS_AS(found(pluvia, "rainy_999"), Error);
    CHECK_THROWS_AS(found({"a.N.X", "a.N.Y", "a.N.Z", "b.N.X", "b.N.Y", "b.N.Z"}, "N"), Error);  // which one?
}

TEST_CASE("the example of --help works") {
    const TemporaryFolder folder;
    const std::string help = run_program("validate compare --help").out;
    const size_t at = help.find("Example:\n  pluvia ");
    REQUIRE(at != std::string::npos);
    std::string line = help.substr(at + 18, help.find('\n', at + 18) - at - 18);
    fs::create_directories(folder / "out/wet");
    write_exr(folder / "out/wet/frame.exr",
              {"background.R", "background.G", "background.B", "rainy_100.R", "rainy_100.G", "rainy_100.B"});
    CAPTURE(line);
    CHECK(std::system(("cd " + folder.path() + " && " + PLUVIA_PROGRAM + " " + line + " >log 2>&1").c_str()) == 0);
    CHECK(fs::exists(folder / "out/rain.html"));
}

TEST_CASE("files of two programs are compared by what they show, per region") {
    const TemporaryFolder folder;
    const std::string a = folder / "a.exr", b = folder / "b.exr";
    write_exr(a, {"background.R", "background.G", "background.B", "Z"}, 1.5f);
    write_exr(b, {"ViewLayer.Combined.R", "ViewLayer.Combined.G", "ViewLayer.Combined.B", "ViewLayer.Depth.Z"});
    const Json j = measured(a + " " + b + " --region left=0,0,12,16");
    CHECK(j["pairs"][0]["kind"] == "light");
    CHECK(j["pairs"][0]["layer_b"] == "ViewLayer.Combined");
    for (const char* region : {"all", "left"}) {
        const Json& m = j["pairs"][0]["regions"][region];
        CHECK(m["bias"].get<double>() == doctest::Approx(0.5).epsilon(1e-6));
        CHECK(m["bias_interval_95"][0].get<double>() < 0.5);
        for (const char* name : {"mse", "relmse", "relmse_trimmed", "psnr", "ssim", "flip_ldr", "flip_hdr", "bias_g"})
            CHECK(m[name].is_number());
    }
    const Json depth = measured(a + " " + b + " --layer depth")["pairs"][0];
    CHECK(depth["kind"] == "depth");
    CHECK(depth["regions"]["all"]["abs_rel"].get<double>() == doctest::Approx(0.5).epsilon(1e-6));
    CHECK(depth["regions"]["all"]["delta1"] == 0);
    CHECK(depth["regions"]["all"]["delta2"] == 1);  // 1.5 < 1.5625
    CHECK(measured(a + " " + b + " --layer Z:ViewLayer.Depth.Z")["pairs"][0]["layer_a"] == "Z");
    const Json same = measured(b + " " + b)["pairs"][0]["regions"]["all"];
    CHECK(same["mse"] == 0);
    CHECK(same["flip_hdr"] == 0);
    CHECK(same["ssim"].get<double>() == doctest::Approx(1));
}

TEST_CASE("pictures of 8 and of 16 bits are taken as stored") {
    const TemporaryFolder folder;
    write_png(folder / "a.png", 8, 51), write_png(folder / "b.png", 16, 26214);  // 0.2 and 0.4
    const Json m = measured((folder / "a.png") + " " + (folder / "b.png"))["pairs"][0]["regions"]["all"];
    CHECK(m["mse"].get<double>() == doctest::Approx(0.04).epsilon(1e-5).scale(0));
    CHECK(m["psnr"].get<double>() == doctest::Approx(10 * std::log10(1 / 0.04)).epsilon(1e-5).scale(0));
    CHECK_FALSE(m.contains("flip_hdr"));
    CHECK(m["flip_ldr"].get<double>() > 0.3);
}

TEST_CASE("folders are compared file by file, masks as masks and depth as depth") {
    const TemporaryFolder folder;
    for (const char* side : {"a", "b"}) {
        const bool is_a = side[0] == 'a';
        fs::create_directories((folder / side) + "/deep");
        write_png((folder / side) + "/deep/background.png", 8, is_a ? 100 : 110);
        write_png((folder / side) + "/rain_mask_050.png", 8, is_a ? 255 : 255, 1);
        write_png((folder / side) + "/depth.png", 16, is_a ? 11 * 256 : 10 * 256, 1);
        write_exr((folder / side) + "/frame.exr", {"background.R", "background.G", "background.B"}, is_a ? 1.1f : 1.0f);
    }
    const std::string both = (folder / "a") + " " + (folder / "b");
    const Json j = measured(both);
    REQUIRE(j["pairs"].size() == 4);
    std::map<std::string, Json> by_name;
    for (const Json& pair : j["pairs"]) by_name[pair["name"]] = pair["regions"]["all"];
    CHECK(by_name["rain_mask_050.png"]["iou"] == 1);
    CHECK(by_name["depth.png"]["abs_rel"].get<double>() == doctest::Approx(0.1));
    CHECK(by_name["frame.exr"]["bias"].get<double>() == doctest::Approx(0.1).epsilon(1e-5).scale(0));
    const double mean =
        (by_name["frame.exr"]["mse"].get<double>() + by_name["deep/background.png"]["mse"].get<double>()) / 2;
    CHECK(j["mean"]["all"]["mse"].get<double>() == doctest::Approx(mean));
    CHECK(run_program("validate compare " + both).out.find("mean") != std::string::npos);
    fs::remove((folder / "b") + "/depth.png");
    const Outcome done = run_program("validate compare " + both);
    CHECK(done.exit_code == 3);
    CHECK(done.err.find("depth.png") != std::string::npos);
}

TEST_CASE("a limit that is passed gives exit code 1 and names the value") {
    const TemporaryFolder folder;
    write_exr(folder / "a.exr", {"R", "G", "B"}, 1.1f), write_exr(folder / "b.exr", {"R", "G", "B"});
    const std::string both = "validate compare --no-flip " + (folder / "a.exr") + " " + (folder / "b.exr");
    CHECK(run_program(both + " --fail bias=0.11 --fail ssim=0.5").exit_code == 0);
    const Outcome done = run_program(both + " --fail bias=0.09");
    CHECK(done.exit_code == 1);
    CHECK(done.err.find("bias is 0.1") != std::string::npos);
    CHECK(run_program(both + " --fail psnr=79").exit_code == 1);
}

TEST_CASE("what cannot be compared is refused with its reason") {
    const TemporaryFolder folder;
    write_exr(folder / "a.exr", {"R", "G", "B"});
    write_png(folder / "a.png", 8, 100);
    PngWriter small(folder / "small.png", 2, 2, 3, 8);
    small.write_rows(0, 2, std::vector<uint8_t>(12).data());
    small.finish();
    {
        ExrWriter writer(folder / "nan.exr", width, height, {{"R", false}, {"G", false}, {"B", false}});
        std::vector<float> plane(width * height, 1.0f);
        plane[30] = std::numeric_limits<float>::quiet_NaN();
        const ExrRows rows[] = {plane.data(), plane.data(), plane.data()};
        writer.write_rows(0, height, rows);
        writer.finish();
    }
    struct Refusal {
        std::string arguments;
        int exit_code;
        std::string word;
    };
    const auto path = [&](const char* name) { return " " + (folder / name); };
    for (const Refusal& r : std::vector<Refusal>{
             {path("a.png") + path("small.png"), 3, "got 24x16, expected 2x2"},
             {path("a.png") + path("absent.png"), 3, "absent.png"},
             {path("a.png") + path("a.exr"), 3, "got display, expected light"},
             {path("a.exr") + path("a.exr") + " --layer rainy_100", 3, "rainy_100"},
             {path("a.png") + path("a.png") + " --layer Z", 3, "no layers"},
             {path("nan.exr") + path("a.exr"), 3, "column 6 of row 1"},
             {path("a.exr") + " " + folder.path(), 3, "folder"},
             {path("a.exr") + path("a.exr") + " --region sky=0,0,25,4", 2, "sky"},
             {path("a.exr") + path("a.exr") + " --region sky=0,0", 2, "--region"},
             {path("a.exr") + path("a.exr") + " --fail beauty=1", 2, "beauty"},
             {path("a.exr") + path("a.exr") + " --fail iou=1", 2, "iou"},
             {path("a.exr") + path("a.exr") + " --fail LPIPS=0.2", 2, "not computed"},
             {path("a.exr") + path("a.exr") + " --fail fid=30", 2, "not computed"},
             {path("a.exr") + path("a.exr") + " --fail mse=low", 2, "mse="},
             {path("a.exr") + path("a.exr") + " --white 0", 2, "--white"},
             {path("a.exr") + path("a.exr") + " --html /proc/nowhere/x.html", 4, "/proc/nowhere"},
         }) {
        const Outcome done = run_program("validate compare" + r.arguments);
        CAPTURE(r.arguments);
        CAPTURE(done.err);
        CHECK(done.exit_code == r.exit_code);
        CHECK(done.err.find(r.word) != std::string::npos);
        CHECK(std::count(done.err.begin(), done.err.end(), '\n') == 1);
        CHECK(done.out.empty());
    }
}

TEST_CASE("the HTML report holds both pictures and the numbers, and asks for nothing from elsewhere") {
    const TemporaryFolder folder;
    write_exr(folder / "a.exr", {"R", "G", "B", "Z"}, 1.1f), write_exr(folder / "b.exr", {"R", "G", "B", "Z"});
    REQUIRE(run_program("validate compare " + (folder / "a.exr") + " " + (folder / "b.exr") + " --layer R,G,B --html " +
                        (folder / "x.html"))
                .exit_code == 3);
    CHECK_FALSE(fs::exists(folder / "x.html"));
    REQUIRE(run_program("validate compare " + (folder / "a.exr") + " " + (folder / "b.exr") +
                        " --layer '' --layer Z --html " + (folder / "x.html"))
                .exit_code == 0);
    const std::string html = read_file(folder / "x.html");
    size_t pictures = 0;
    for (size_t at = 0; (at = html.find("data:image/png;base64,", at)) != std::string::npos; ++at) ++pictures;
    CHECK(pictures == 4 + 3);  // A, B, error and difference of light; A, B and error of depth
    CHECK(html.find("http") == std::string::npos);
    CHECK(html.find("relmse_trimmed") != std::string::npos);
    CHECK(html.ends_with("</html>\n"));
}

}  // namespace pluvia
