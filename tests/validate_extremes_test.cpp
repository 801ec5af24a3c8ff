// Everything that `pluvia validate extremes` measures, in its short form, and that it can fail.
#include "tests/run_program.h"
#include "tools/validate/extremes.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace pluvia {

TEST_CASE("at the ends of what is allowed comes out what physics or arithmetic says") {
    for (const ExtremeSubject& subject : extreme_subjects())
        for (const ExtremeResult& r : subject.measure(false)) {
            CAPTURE(subject.name);
            CAPTURE(r.quantity);
            CAPTURE(r.expected);
            CAPTURE(r.got);
            CAPTURE(r.tolerance);
            CAPTURE(r.standard_error);
            CHECK(r.passed());
        }
}

TEST_CASE("an extreme fails beyond its tolerance, with too much noise and when it is no number") {
    CHECK(ExtremeResult{"", 1, 1.01, 0.02}.passed());
    CHECK_FALSE(ExtremeResult{"", 1, 1.03, 0.02}.passed());
    CHECK(ExtremeResult{"", 1, 1.03, 0.02, 0.003}.passed());
    CHECK_FALSE(ExtremeResult{"", 1, 1, 0.02, 0.06}.passed());
    CHECK_FALSE(ExtremeResult{"", 1, std::nan(""), 1}.passed());

    Picture picture;
    picture.width = 2, picture.height = 1;
    picture.planes = {{"background.G", {1, 2}}, {"Z", {1, INFINITY}}};
    CHECK(sound_mean(picture, "background.G") == 1.5);
    picture.planes["rain_050.A"] = {0, -1e-9f};
    CHECK(std::isnan(sound_mean(picture, "background.G")));
    picture.planes["rain_050.A"] = {0, INFINITY};
    CHECK(std::isnan(sound_mean(picture, "background.G")));
    picture.planes["rain_050.A"] = {0, 0};
    picture.report.counters.invalid_samples = 1;
    CHECK(std::isnan(sound_mean(picture, "background.G")));
}

TEST_CASE("validate extremes prints what it measures") {
    const Outcome table = run_program("validate extremes --short --only drops");
    CHECK(table.exit_code == 0);
    CHECK(table.out.find("pass  drop that hangs still") != std::string::npos);
    const auto json = nlohmann::json::parse(run_program("validate extremes --only drops --json").out);
    CHECK(json["drops"].size() >= 8);
    for (const auto& result : json["drops"]) CHECK(result["pass"] == true);
    const Outcome mistake = run_program("validate extremes --only beauty");
    CHECK(mistake.exit_code == 2);
    CHECK(mistake.err.find("geometry") != std::string::npos);
}

}  // namespace pluvia
