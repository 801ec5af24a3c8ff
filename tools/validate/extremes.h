// Hard cases: settings and scenes at the ends of what is allowed, each with a value that physics or arithmetic says
// must come out. Run by `pluvia validate extremes`, in a short form by the tests; one file per subject.
#pragma once

#include "tools/validate/rendered_picture.h"

#include <string>
#include <vector>

namespace pluvia {

class RunningMean;

struct ExtremeResult {
    std::string quantity;
    double expected = 0, got = 0;
    double tolerance = 0;       // absolute
    double standard_error = 0;  // of got where it is a mean over seeds

    /// Within the tolerance and five standard errors, which must be below 5 % of the expectation; no NaN passes.
    bool passed() const;
};

struct ExtremeSubject {
    const char* name;
    /// full: also the cases that take long or much memory.
    std::vector<ExtremeResult> (*measure)(bool full);
};

/// All of them, in the order in which they are printed.
const std::vector<ExtremeSubject>& extreme_subjects();

std::vector<ExtremeResult> measure_rain_extremes(bool full);
std::vector<ExtremeResult> measure_drop_extremes(bool full);
std::vector<ExtremeResult> measure_camera_extremes(bool full);
std::vector<ExtremeResult> measure_scale_extremes(bool full);
std::vector<ExtremeResult> measure_sun_extremes(bool full);
std::vector<ExtremeResult> measure_lamp_extremes(bool full);
std::vector<ExtremeResult> measure_material_extremes(bool full);
std::vector<ExtremeResult> measure_geometry_extremes(bool full);
std::vector<ExtremeResult> measure_picture_extremes(bool full);

/// The channel's mean; NaN, which fails, when anywhere in the picture a sample was lost or a value of light or coverage
/// is negative or not finite.
double sound_mean(const Picture& picture, const std::string& channel);
/// The same over a number of seeds, which are those of the drops as well.
RunningMean sound_means(const Scene& scene, const Environment& environment, const View& view, RenderSettings settings,
                        const std::string& channel, int seeds);

/// tolerance: relative to the expectation.
ExtremeResult relative_result(const std::string& quantity, double expected, double got, double tolerance);
ExtremeResult mean_result(const std::string& quantity, double expected, const RunningMean& got, double tolerance = 0);

}  // namespace pluvia
