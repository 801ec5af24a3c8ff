// What accuracy costs: numbers of `pluvia validate trade` on a small scene, and the named qualities.
#include "renderer/scene/gltf.h"
#include "tests/run_program.h"
#include "tests/temporary_folder.h"
#include "tools/quality.h"
#include "tools/validate/known_scenes.h"
#include "tools/validate/trade.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <map>

namespace pluvia {
namespace {

using Json = nlohmann::json;

std::string court_file(const TemporaryFolder& folder) {
    save_glb(make_court(lambert(Rgb(0.7f))), folder / "court.glb");
    return folder / "court.glb";
}

}  // namespace

TEST_CASE("the front is what nothing beats in both time and error") {
    const auto result = [](double cpu, double error) {
        TradeResult r;
        r.cpu_s = cpu, r.background.error = error;
        return r;
    };
    CHECK(pareto_front({result(1, 0.5), result(2, 0.5), result(2, 0.3), result(3, 0.4), result(9, 0.1)}) ==
          std::vector<bool>{true, false, true, false, true});
    CHECK(pareto_front({result(1, 1), result(1, 1)}) == std::vector<bool>{true, true});
}

TEST_CASE("an error counts the worse layer, in the unit of the picture's own light") {
    Image<Rgb> reference(100, 100), got(100, 100);
    for (size_t i = 0; i < reference.pixels.size(); ++i) {
        reference.pixels[i] = Rgb(10);
        got.pixels[i] = Rgb(i % 2 ? 11.0f : 10.0f);
    }
    const LayerError e = error_of_layer(got, reference);
    CHECK(e.error == doctest::Approx(std::sqrt(0.5) * 0.1).epsilon(1e-3).scale(0));  // 1 of 10 in every other pixel
    CHECK(e.bias == doctest::Approx(0.05).epsilon(1e-4).scale(0));
    CHECK(e.flip > 0);
    TradeResult r;
    r.background = e;
    r.rainy = LayerError{2 * e.error, 0};
    CHECK(r.error() == 2 * e.error);
    CHECK(r.flip() == e.flip);
}

TEST_CASE("trade finds what samples buy and bounces lose, and does nothing twice") {
    const TemporaryFolder folder;
    const std::string command = "validate trade " + court_file(folder) + " -o " + (folder / "trade") +
                                " --size 48x24 --environment 5,5,5 --spp 16 --reference-spp 1024 --progress none " +
                                "--rain 100 --json --only samples,bounces";
    const Outcome first = run_program(command);
    CAPTURE(first.err);
    REQUIRE(first.exit_code == 0);
    const Json json = Json::parse(first.out);
    std::map<std::string, Json> found;
    for (const Json& r : json["results"]) found[r["dial"].get<std::string>() + " " + r["value"].get<std::string>()] = r;
    REQUIRE(found.count("samples 64") == 1);
    CHECK(json["reference"]["samples"] == 1024);
    const double own = json["reference"]["error"];
    const auto error = [&](const std::string& key) { return found[key]["background"]["error"].get<double>(); };
    CHECK(own > 0);
    CHECK(own < 0.3 * error("samples 16"));
    // As the square root of the samples, 0.5, but for the reference's own error and the scatter of 1152 pixels.
    CHECK(error("samples 16") < 0.7 * error("samples 4"));
    CHECK(error("samples 64") < 0.7 * error("samples 16"));
    CHECK(found["samples 64"]["cpu_s"] > found["samples 4"]["cpu_s"]);
    CHECK(found["samples 256"]["biased"] == false);
    CHECK(std::abs(found["samples 256"]["background"]["bias"].get<double>()) < 0.01);
    CHECK(found["bounces 1"]["biased"] == true);
    CHECK(found["bounces 1"]["background"]["bias_high"] < 0);
    CHECK(found["bounces 1"]["rainy"]["bias_high"] < 0);
    CHECK(found["bounces 8"]["background"]["bias"] > -0.01);
    const std::string page = read_file(folder / "trade/trade.html");
    CHECK(page.find("<svg") != std::string::npos);
    CHECK(page.find("nan") == std::string::npos);

    // Times are measured anew only where something is rendered.
    const Outcome again = run_program(command);
    CHECK((again.out == first.out));
    CHECK((read_file(folder / "trade/trade.html") == page));
    const Outcome other = run_program(command + " --seed 7");
    REQUIRE(other.exit_code == 0);
    CHECK(Json::parse(other.out)["results"][0]["background"] != json["results"][0]["background"]);
    CHECK(run_program(command + ",nothing").exit_code == 2);
}

TEST_CASE("a quality sets what is not given beside it, in any order") {
    const TemporaryFolder folder;
    const std::string common = "render " + court_file(folder) +
                               " --size 16x8 --environment 1,1,1 --rain 10 --progress none --overwrite -o " +
                               (folder / "a");
    const auto spp = [&](const std::string& options) -> int {
        const Outcome run = run_program(common + options);
        CAPTURE(run.err);
        REQUIRE(run.exit_code == 0);
        return Json::parse(read_file(folder / "a/frame.json"))["settings"]["spp"];
    };
    CHECK(spp(" --quality draft") == qualities().front().samples);
    CHECK(spp(" --quality draft --spp 3") == 3);
    CHECK(spp(" --spp 3 --quality draft") == 3);
    CHECK(run_program(common + " --quality best").exit_code == 2);
}

TEST_CASE("qualities get more accurate in their order, and the default is standard") {
    for (size_t i = 1; i < qualities().size(); ++i) CHECK(qualities()[i].samples > qualities()[i - 1].samples);
    RenderOptions standard;
    set_quality(standard, "standard");
    CHECK(to_json(standard) == to_json(RenderOptions()));
}

}  // namespace pluvia
