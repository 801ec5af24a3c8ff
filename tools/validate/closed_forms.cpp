#include "tools/validate/closed_forms.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pluvia {

bool ClosedFormResult::passed() const {
    // Written so that what is not a number fails.
    return std::abs(got - expected) <= 5 * standard_error + tolerance && standard_error <= 1e-3 * std::abs(expected);
}

double ClosedFormResult::sigmas() const {
    const double beyond = std::max(0.0, std::abs(got - expected) - tolerance);
    return beyond == 0 ? 0 : standard_error == 0 ? std::numeric_limits<double>::infinity() : beyond / standard_error;
}

ClosedFormResult rendered_result(const std::string& quantity, double expected, double relative_tolerance,
                                 const Estimate& estimate) {
    return {quantity, expected, estimate.mean, estimate.standard_error, relative_tolerance * std::abs(expected)};
}

const std::vector<ClosedForm>& closed_forms() {
    static const std::vector<ClosedForm> list = {
        {"furnaces", measure_furnaces},
        {"albedos", measure_albedos},
        {"panes", measure_panes},
        {"bodies", measure_bodies},
        {"punctual-lights", measure_punctual_lights},
        {"area-lights", measure_area_lights},
        {"environments", measure_environments},
        {"rain", measure_rain},
        {"drops", measure_drops},
    };
    return list;
}

}  // namespace pluvia
