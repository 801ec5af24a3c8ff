// Scenes whose light is known on paper: what the program renders of them, and what it should.
// Run by `pluvia validate closed-forms` and by the tests; scenes are made by known_scenes.h.
#pragma once

#include "tools/validate/rendered_picture.h"

#include <cstdint>
#include <string>
#include <vector>

namespace pluvia {

/// One quantity. The expectation is a formula or a quadrature that traces no path.
struct ClosedFormResult {
    std::string quantity;
    double expected = 0, got = 0;
    double standard_error = 0;  // of got, and of expected where that is sampled too
    double tolerance = 0;       // what rounding, tables or the quadrature may add, absolute

    /// Within five sigma, and with an error so small that a deviation of 0.5 % would be seen.
    bool passed() const;
    /// How many standard errors lie between them beyond the tolerance.
    double sigmas() const;
};

struct ClosedForm {
    const char* name;
    std::vector<ClosedFormResult> (*measure)(uint64_t seed);
};

/// All of them, in the order in which they are printed.
const std::vector<ClosedForm>& closed_forms();

// By subject. seed: the first of the seeds that are averaged.
std::vector<ClosedFormResult> measure_furnaces(uint64_t seed);
std::vector<ClosedFormResult> measure_albedos(uint64_t seed);
std::vector<ClosedFormResult> measure_panes(uint64_t seed);
std::vector<ClosedFormResult> measure_bodies(uint64_t seed);
std::vector<ClosedFormResult> measure_punctual_lights(uint64_t seed);
std::vector<ClosedFormResult> measure_area_lights(uint64_t seed);
std::vector<ClosedFormResult> measure_environments(uint64_t seed);
std::vector<ClosedFormResult> measure_rain(uint64_t seed);
std::vector<ClosedFormResult> measure_drops(uint64_t seed);

/// A picture's mean over seeds as a result. relative_tolerance: of the expectation.
ClosedFormResult rendered_result(const std::string& quantity, double expected, double relative_tolerance,
                                 const Estimate& estimate);

}  // namespace pluvia
