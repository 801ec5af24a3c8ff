// Everything that `pluvia validate closed-forms` measures, and that it can fail.
#include "tests/run_program.h"
#include "tools/validate/closed_forms.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace pluvia {

TEST_CASE("what is rendered of scenes known on paper is what the paper says, within five sigma and 0.1 %") {
    for (const ClosedForm& form : closed_forms())
        for (const ClosedFormResult& r : form.measure(1000)) {
            CAPTURE(form.name);
            CAPTURE(r.quantity);
            CAPTURE(r.expected);
            CAPTURE(r.got);
            CAPTURE(r.standard_error);
            CHECK(r.passed());
            CHECK(r.tolerance <= 1e-3 * std::abs(r.expected) + 5e-4);
        }
}

TEST_CASE("a deviation beyond five sigma, too much noise and what is no number fail") {
    CHECK(ClosedFormResult{"", 1, 1.0049, 1e-3, 0}.passed());
    CHECK_FALSE(ClosedFormResult{"", 1, 1.0051, 1e-3, 0}.passed());
    CHECK(ClosedFormResult{"", 1, 1.0051, 1e-3, 1e-3}.passed());
    CHECK_FALSE(ClosedFormResult{"", 1, 1, 1.1e-3, 0}.passed());
    CHECK_FALSE(ClosedFormResult{"", 1, std::nan(""), 1e-3, 0}.passed());
    CHECK_FALSE(ClosedFormResult{"", 1, 1.1, 0, 0}.passed());
    CHECK(ClosedFormResult{"", 1, 1.003, 1e-3, 1e-3}.sigmas() == doctest::Approx(2));
}

TEST_CASE("validate closed-forms prints what it measures, with its seeds") {
    const Outcome table = run_program("validate closed-forms --only drops --seed 3");
    CHECK(table.exit_code == 0);
    CHECK(table.out.find("seeds from 3") != std::string::npos);
    CHECK(table.out.find("pass  light that a drop turns by 0 to 15 degrees") != std::string::npos);
    const auto json = nlohmann::json::parse(run_program("validate closed-forms --only drops --json").out);
    CHECK(json["drops"].size() >= 6);
    for (const auto& result : json["drops"]) CHECK(result["pass"] == true);
    const Outcome mistake = run_program("validate closed-forms --only beauty");
    CHECK(mistake.exit_code == 2);
    CHECK(mistake.err.find("area-lights") != std::string::npos);
}

}  // namespace pluvia
