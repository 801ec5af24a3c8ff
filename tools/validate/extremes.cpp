#include "tools/validate/extremes.h"

#include "tools/validate/running_mean.h"

#include <cmath>
#include <limits>

namespace pluvia {

bool ExtremeResult::passed() const {
    // Written so that what is not a number fails.
    return std::abs(got - expected) <= tolerance + 5 * standard_error && standard_error <= 0.05 * std::abs(expected);
}

const std::vector<ExtremeSubject>& extreme_subjects() {
    static const std::vector<ExtremeSubject> list = {
        {"rain", measure_rain_extremes},
        {"drops", measure_drop_extremes},
        {"camera", measure_camera_extremes},
        {"scale", measure_scale_extremes},
        {"sun", measure_sun_extremes},
        {"lamps", measure_lamp_extremes},
        {"materials", measure_material_extremes},
        {"geometry", measure_geometry_extremes},
        {"pictures", measure_picture_extremes},
    };
    return list;
}

double sound_mean(const Picture& picture, const std::string& channel) {
    bool sound = picture.report.counters.invalid_samples == 0;
    for (const auto& [name, plane] : picture.planes) {
        const bool depth = name == "Z" || name == "distance.Y" || name.starts_with("rainy_Z");
        for (const float v : plane) sound = sound && v >= 0 && (depth || std::isfinite(v));
    }
    return sound ? picture.mean(channel) : std::numeric_limits<double>::quiet_NaN();
}

RunningMean sound_means(const Scene& scene, const Environment& environment, const View& view, RenderSettings settings,
                        const std::string& channel, int seeds) {
    RunningMean mean;
    for (int k = 0; k < seeds; ++k) {
        settings.seed = settings.rain.seed = 1000 + uint64_t(k);
        mean.add(sound_mean(render_picture(scene, environment, view, settings), channel));
    }
    return mean;
}

ExtremeResult relative_result(const std::string& quantity, double expected, double got, double tolerance) {
    return {quantity, expected, got, tolerance * std::abs(expected)};
}

ExtremeResult mean_result(const std::string& quantity, double expected, const RunningMean& got, double tolerance) {
    return {quantity, expected, got.mean(), tolerance, got.standard_error()};
}

}  // namespace pluvia
