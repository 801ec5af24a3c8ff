#include "tools/learning/crig_config.h"

#include "renderer/core/error.h"

#include <fmt/format.h>

namespace pluvia {
namespace {

constexpr const char* first_weight = "decoder.init.init.0.weight_orig";

}  // namespace

bool is_crig(const SafetensorsFile& file) {
    return file.has(first_weight);
}

CrigConfig crig_config(const SafetensorsFile& file) {
    const auto found = file.entries().find(first_weight);
    if (found == file.entries().end())
        throw input_error(file.path(), fmt::format("holds no CRIGNet: it has no tensor \"{}\"", first_weight));
    const TensorShape& shape = found->second.shape;
    constexpr int64_t widest = 32, most = 512;
    if (shape.size() != 4 || shape[0] <= crig_labels || shape[0] > 8192 || shape[1] < 2 * widest ||
        shape[1] % (2 * widest) != 0 || shape[1] > widest * most)
        throw input_error(file.path(), fmt::format("tensor \"{}\" has a shape that no CRIGNet has (got {})",
                                                   first_weight, shape_text(shape)));
    if (!file.has("decoder.feat_256.1.weight_orig") || file.has("decoder.feat_512.1.weight_orig"))
        throw input_error(file.path(), "holds a CRIGNet of another size than 256 pixels, which is not supported");
    return {shape[0] - crig_labels, shape[1] / widest};
}

CrigLabel crig_label(double intensity_mm_per_h, double wind) {
    if (!(intensity_mm_per_h >= 0 && intensity_mm_per_h <= 100))
        throw usage_error("--rain", fmt::format("is not valid (got {}, expected 0 to 100 mm/h, which CRIGNet knows)",
                                                intensity_mm_per_h));
    if (!(wind >= -1 && wind <= 1))
        throw usage_error("--wind", fmt::format("is not valid (got {}, expected -1 to 1, CRIGNet's own scale)", wind));
    return {float(intensity_mm_per_h / crig_mm_per_h - 1), float(wind)};
}

}  // namespace pluvia
