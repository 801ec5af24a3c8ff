// The program as users meet it: exit codes, messages, files, and the same bytes twice.
#include "renderer/core/error.h"
#include "renderer/image/exr.h"
#include "renderer/image/image_io.h"
#include "renderer/scene/gltf.h"
#include "tests/run_program.h"
#include "tests/temporary_folder.h"
#include "tests/test_scenes.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <fcntl.h>
#include <sys/wait.h>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <set>
#include <thread>

namespace pluvia {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

/// A court with a lamp, as a user's file.
std::string write_scene(const TemporaryFolder& folder) {
    Scene scene = make_court(lambert(Rgb(0.5f)));
    add_sphere(scene, {1, 3, -2}, 0.2f, 16, emitter(Rgb(500)));
    scene.cameras.push_back({"eye", translate({1, 1.6, 3.5}), 0.6});
    save_glb(scene, folder / "court.glb");
    return folder / "court.glb";
}

const std::string small = " --size 64x32 --spp 2 --progress none ";

std::set<std::string> names_in(const std::string& folder) {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename());
    return names;
}

}  // namespace

TEST_CASE("every command explains itself with an example") {
    for (const char* command : {"render", "scenes", "inspect", "sky"}) {
        const Outcome help = run_program(std::string(command) + " --help");
        CAPTURE(command);
        CHECK(help.exit_code == 0);
        CHECK(help.out.find("Example:") != std::string::npos);
        CHECK(help.out.find(std::string("pluvia ") + command) != std::string::npos);
    }
    CHECK(run_program("--help").exit_code == 0);
    CHECK(run_program("--version").out.find("0.") != std::string::npos);
}

TEST_CASE("the examples that --help shows work") {
    const TemporaryFolder folder;
    fs::create_symlink(PLUVIA_PROGRAM, folder / "pluvia");
    REQUIRE(run_program("scenes lane -o " + folder.path()).exit_code == 0);
    CHECK(run_program("scenes --list").out.find("lane") != std::string::npos);
    int examples = 0;
    for (const char* command : {"", "render", "scenes", "inspect", "sky"}) {
        std::istringstream help(run_program(std::string(command) + " --help").out);
        std::string line;
        while (std::getline(help, line) && line != "Example:") {
        }
        for (; std::getline(help, line) && line.starts_with("  pluvia "); ++examples) {
            // The last command of a line is a render but for those of other commands; its frame may exist by now.
            if (line.find("pluvia render") != std::string::npos) line += small + "--overwrite";
            CAPTURE(line);
            CHECK(std::system(("cd " + folder.path() + "; PATH=.:$PATH; { " + line + "; } >log 2>&1").c_str()) == 0);
        }
    }
    CHECK(examples >= 6);
}

TEST_CASE("of an option given twice the last one counts, and a list ends where the next word begins") {
    const TemporaryFolder folder;
    const std::string scene = write_scene(folder), out = folder / "out";
    const Outcome done = run_program("render" + small + "--wind -1,0,2 --rain 10,50 " + scene +
                                     " --size 16x8 --rain 25 --overwrite --overwrite -o " + out);
    CAPTURE(done.err);
    REQUIRE(done.exit_code == 0);
    const Json settings = Json::parse(read_file(out + "/frame.json"))["settings"];
    CHECK(settings["size"] == "16x8");
    CHECK(settings["wind"] == Json::array({-1.0, 0.0, 2.0}));
    CHECK(settings["rain"] == Json::array({10.0, 50.0, 25.0}));
}

TEST_CASE("a scene whose file name is not UTF-8 is rendered and inspected like any other") {
    const TemporaryFolder folder;
    const std::string scene = folder / "stra\337e.glb", out = folder / "out";  // Latin-1
    fs::rename(write_scene(folder), scene);
    CHECK(run_program("render " + scene + small + "-o " + out).exit_code == 0);
    CHECK(Json::parse(read_file(out + "/frame.json"))["scene"]["name"] == "stra\uFFFDe");
    CHECK(Json::parse(run_program("inspect --json " + scene).out)["scene"] == "stra\uFFFDe");
}

TEST_CASE("a frame has all its files, layers and records") {
    const TemporaryFolder folder;
    const std::string scene = write_scene(folder), out = folder / "frame";
    const Outcome done =
        run_program("render " + scene + small + "--rain 12.5,100 --streak-width 0.25 --json -o " + out);
    CAPTURE(done.err);
    REQUIRE(done.exit_code == 0);
    CHECK(names_in(out) == std::set<std::string>{"background.png", "depth.png", "frame.exr", "frame.json",
                                                 "rain_layer_012p5.png", "rain_layer_100.png", "rain_mask_012p5.png",
                                                 "rain_mask_100.png", "rainy_012p5.png", "rainy_100.png"});
    ExrReader exr(out + "/frame.exr");
    for (const char* channel : {"background.R", "Z", "distance.Y", "transmittance_012p5.G", "rain_100.B", "rain_100.A",
                                "inscatter_100.R", "rainy_100.R", "rainy_Z_012p5"}) {
        CAPTURE(channel);
        CHECK(exr.has_channel(channel));
    }
    const Json record = Json::parse(read_file(out + "/frame.json"));
    CHECK(record["settings"]["rain"] == Json::array({12.5, 100.0}));
    CHECK(record["settings"]["weather"] == "rain");
    CHECK(record["invalid_samples"] == 0);
    CHECK(Json::parse(done.out)["camera_paths"] == 64 * 32 * 2);
    CHECK(done.err.find("--weather") != std::string::npos);  // it says which sky was taken

    // Depth in the PNG is depth in the EXR; masks are black and white.
    std::vector<float> z(64 * 32);
    const ExrRequest request{"Z", z.data()};
    exr.read_rows(0, 32, std::span(&request, 1));
    const auto depth = read_grey16(out + "/depth.png");
    for (size_t i = 0; i < z.size(); ++i)
        CHECK(std::abs(depth.pixels[i] - (std::isfinite(z[i]) ? z[i] * 256 : 0)) <= 0.5);
    for (const Rgba8 p : read_rgba8(out + "/rain_mask_100.png").pixels) CHECK((p.r == 0 || p.r == 255));
}

TEST_CASE("the same command gives the same bytes, with one thread or two, anywhere") {
    const TemporaryFolder here, there;
    const std::string scene = write_scene(here);
    fs::copy_file(scene, there / "court.glb");
    const std::string options = small + "--rain 10,50 --streak-width 0.5 --hour 21 -o ";
    REQUIRE(run_program("render " + scene + options + (here / "a") + " --threads 1").exit_code == 0);
    char today[8];
    const std::time_t now = std::time(nullptr);
    std::strftime(today, sizeof today, "%Y-%m", std::gmtime(&now));
    REQUIRE(run_program("render " + (there / "court.glb") + options + (there / "b") + " --threads 2").exit_code == 0);
    for (const std::string& name : names_in(here / "a")) {
        CAPTURE(name);
        const std::string bytes = read_file((here / "a") + "/" + name);
        CHECK(bytes == read_file((there / "b") + "/" + name));
        CHECK(bytes.find(here.path()) == std::string::npos);  // no product knows where it was made, and when
        CHECK(bytes.find(today) == std::string::npos);
        CHECK(bytes.find(std::string(today).replace(4, 1, ":")) == std::string::npos);  // as EXR and EXIF write it
    }
}

TEST_CASE("mistakes get one line that says where, what, got and expected, and their exit code") {
    const TemporaryFolder folder;
    const std::string scene = write_scene(folder), to = " -o " + (folder / "out");
    write_file(folder / "letter.glb", "no scene");
    struct Mistake {
        std::string arguments;
        int exit_code;
        std::string word;
    };
    std::vector<Mistake> mistakes = {
        {"render " + scene + to + " --date 2024-13-40", 2, "2024-13-40"},
        {"sky --date 2025-02-31", 2, "2025-2-31"},
        {"sky --latitude 95", 2, "-90 to 90"},
        {"sky --hour 25", 2, "0 to 24"},
        {"sky --cloud-cover 2", 2, "0 to 1"},
        {"sky --weather snow", 2, "thunderstorm"},
        {"sky --strip", 2, "--strip"},
        {"sky -o /proc/nowhere/sky.exr", 4, "/proc/nowhere"},
        {"render " + scene + to + " --view nice", 2, "nice"},
        {"render " + scene + to + " --camera nobody", 2, "eye"},
        {"render " + scene + to + " --environment 1,1,1 --environment-scale nan", 2, "--environment-scale"},
        {"render " + scene + to + " --environment 1,1,1 --environment-illuminance inf", 2, "--environment-illum"},
        {"render " + scene + to + " --f-number 2 --focus inf", 2, "--focus"},
        {"render " + scene + to + " --depth-encoding hri --depth-max 0", 2, "--depth-max"},
        {"render " + scene + " " + scene + to, 2, "not expected"},
        {"render " + scene + " -o " + (folder / std::string(300, 'a')), 4, "too long"},
        {"render " + scene + " -o " + (folder / "letter.glb/out"), 4, "letter.glb/out"},
        {"render " + scene + to + " --environment absent.hdr", 3, "absent.hdr"},
        {"render " + (folder / "absent.glb") + to, 3, "absent.glb"},
        {"render " + (folder / "letter.glb") + to, 3, "letter.glb"},
        {"render " + scene + " -o /proc/nowhere", 4, "/proc/nowhere"},
        {"scenes atlantis", 2, "atlantis"},
        {"inspect", 2, "inspect"},
        {"atlantis", 2, "no command \"atlantis\""},
        {"", 2, ""},
    };
    // Of these the message names the option.
    std::istringstream options(
        "--spp 0|--size 10|--rain 9000|--rain nan|--rain 10,10|--hour 25|--weather snow|"
        "--exposure bright|--depth-encoding foo|--focus 3|--bounces -2|--composition art|--bounces 1.5|"
        "--seed -1|--threads -1|--wind 1,2|--camera-velocity nan,0,0|--streak-width 0|--veil thick|--streak-gain inf|--fog-beta -1|"
        "--latitude 91|--longitude nan|--utc-offset 99|--sun-elevation 100|--sun-azimuth nan|"
        "--turbidity 0.5|--cloud-cover 2|--cloud-cover nan|--cloud-type fluffy|--city-glow bright|--city-glow -1|"
        "--lamps dim|--environment 1,-1,1|--focal-length 0|--f-number 0|--shutter 0|--fps 0|"
        "--frame 9999999999|--progress loud|--no-such-option");
    for (std::string option; std::getline(options, option, '|');)
        mistakes.push_back({"render " + scene + to + " " + option, 2, option.substr(0, option.find(' '))});
    for (const Mistake& m : mistakes) {
        const Outcome o = run_program(m.arguments);
        CAPTURE(m.arguments);
        CAPTURE(o.err);
        CHECK(o.exit_code == m.exit_code);
        CHECK(o.err.starts_with("pluvia: error: "));
        CHECK(o.err.find(m.word) != std::string::npos);
        if (o.err.starts_with("pluvia: error: --")) {
            CHECK(o.err.find("(got ") != std::string::npos);
            CHECK(o.err.find(", expected ") != std::string::npos);
        }
        CHECK(std::count(o.err.begin(), o.err.end(), '\n') == 1);
        CHECK_FALSE(fs::exists(folder / "out/frame.json"));
    }
}

TEST_CASE("a finished frame is not replaced by accident") {
    const TemporaryFolder folder;
    const std::string command = "render " + write_scene(folder) + small + "-o " + (folder / "out");
    REQUIRE(run_program(command).exit_code == 0);
    const std::string before = read_file(folder / "out/frame.exr");
    CHECK(run_program(command + " --seed 9").exit_code == 2);
    CHECK(read_file(folder / "out/frame.exr") == before);
    CHECK(run_program(command + " --seed 9 --overwrite").exit_code == 0);
    CHECK(read_file(folder / "out/frame.exr") != before);
}

TEST_CASE("an interrupted render stops with 75 and leaves no file that looks finished") {
    const TemporaryFolder folder;
    const std::string scene = write_scene(folder), out = folder / "out";
    const pid_t child = fork();
    if (child == 0) {
        const int null = open("/dev/null", O_WRONLY);
        dup2(null, 1), dup2(null, 2);
        execl(PLUVIA_PROGRAM, "pluvia", "render", scene.c_str(), "-o", out.c_str(), "--spp", "100000", "--progress",
              "none", static_cast<char*>(nullptr));
        _exit(127);
    }
    // Wait until it renders: then the picture is being written under its temporary name.
    for (int i = 0; i < 400 && !fs::exists(out + "/frame.tmp.exr"); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(25));
    kill(child, SIGINT);
    int status = 0;
    waitpid(child, &status, 0);
    REQUIRE(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 75);
    CHECK(names_in(out).empty());
}

TEST_CASE("progress as JSON lines can be parsed") {
    const TemporaryFolder folder;
    const Outcome o =
        run_program("render " + write_scene(folder) + " --size 64x32 --spp 2 --progress json -o " + (folder / "out"));
    REQUIRE(o.exit_code == 0);
    const std::string last = o.err.substr(o.err.rfind('\n', o.err.size() - 2) + 1);
    CHECK(Json::parse(last)["progress"] == 1.0);
}

TEST_CASE("inspect tells what a scene requires, what a frame holds and what rain consists of") {
    const TemporaryFolder folder;
    const std::string scene = write_scene(folder);
    const Json court = Json::parse(run_program("inspect " + scene + " --json").out);
    CHECK(court["cameras"][0]["name"] == "eye");
    CHECK(court["requires"]["emissive_materials"] == 1);
    CHECK(court["requires"]["textured_materials"] == 0);
    REQUIRE(run_program("render " + scene + small + "-o " + (folder / "out")).exit_code == 0);
    const Json frame = Json::parse(run_program("inspect " + (folder / "out/frame.exr") + " --json").out);
    CHECK(frame["width"] == 64);
    CHECK(frame["attributes"]["pluvia:settings"]["spp"] == 2);
    const Json rain = Json::parse(run_program("inspect --rain 100 --json").out);
    CHECK(rain["rain"]["100"]["drops_per_m3"].get<double>() ==
          doctest::Approx(4391).epsilon(1e-3));  // Marshall and Palmer
    const double expected = rain["rain"]["100"]["resolved_drops_expected"],
                 drawn = rain["rain"]["100"]["resolved_drops_drawn"];
    CHECK(expected > 7e5);
    CHECK(std::abs(drawn - expected) < 5 * std::sqrt(expected));
}

TEST_CASE("sky tells the light in numbers, and its panorama gives the same light back") {
    const TemporaryFolder folder;
    const std::string exr = folder / "new/sky.exr";  // in a folder that is made
    const Outcome o = run_program("sky --hour 15 --weather fair --json -o " + exr);
    CAPTURE(o.err);
    REQUIRE(o.exit_code == 0);
    const Json j = Json::parse(o.out);
    const double total = j["illuminance_total_lux"];
    CHECK(total > 20e3);
    CHECK(j["illuminance_direct_lux"].get<double>() + j["illuminance_sky_lux"].get<double>() == doctest::Approx(total));
    CHECK(j["sun"]["elevation_degrees"].get<double>() > 20);
    CHECK(j["moon"]["lit_share"].get<double>() <= 1);
    CHECK(j["color_temperature_kelvin"]["direct"].get<double>() < j["color_temperature_kelvin"]["total"].get<double>());
    CHECK(j["color_temperature_kelvin"]["total"].get<double>() < j["color_temperature_kelvin"]["sky"].get<double>());
    CHECK(Environment(read_radiance(exr)).horizontal_illuminance() == doctest::Approx(total).epsilon(0.005).scale(0));
    const Json overcast = Json::parse(run_program("sky --sun-elevation 30 --weather overcast --json").out);
    CHECK(overcast["illuminance_direct_lux"] == 0);
    CHECK(run_program("sky --hour 15 --weather fair").out.find("lux") != std::string::npos);
}

TEST_CASE("hour 24 is hour 0 of the next day, to the last byte of a frame") {
    const TemporaryFolder folder;
    const std::string late = folder / "late.exr", early = folder / "early.exr";
    const std::string a = run_program("sky --json --date 2024-02-29 --hour 24 --utc-offset 5.5 -o " + late).out;
    CHECK(a == run_program("sky --json --date 2024-03-01 --hour 0 --utc-offset 5.5 -o " + early).out);
    CHECK(read_radiance(late).pixels == read_radiance(early).pixels);
}

TEST_CASE("lamps are off by day and on by night, unless told otherwise") {
    const TemporaryFolder folder;
    Scene scene;
    Material glass = emitter(Rgb(500));
    glass.lamp = true;
    add_quad(scene, {-2, 0, -2}, {4, 0, 0}, {0, 4, 0}, glass);
    scene.cameras.push_back({"eye", translate({0, 2, 3}), 0.3});
    save_glb(scene, folder / "lamp.glb");
    const auto green = [&](const std::string& options) {
        const std::string out = folder / "out";
        REQUIRE(run_program("render " + (folder / "lamp.glb") + " --size 4x4 --spp 1 --progress none --overwrite -o " +
                            out + " " + options)
                    .exit_code == 0);
        ExrReader exr(out + "/frame.exr");
        std::vector<float> values(16);
        const ExrRequest request{"background.G", values.data()};
        exr.read_rows(0, 4, std::span(&request, 1));
        return values[5];
    };
    CHECK(green("--sun-elevation 20") == 0);
    CHECK(green("--sun-elevation -6") == doctest::Approx(500));
    CHECK(green("--sun-elevation 20 --lamps on") == doctest::Approx(500));
    CHECK(green("--sun-elevation -6 --lamps off") == 0);
}

}  // namespace pluvia
