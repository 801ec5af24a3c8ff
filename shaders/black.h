// A surface that absorbs all light: what is unlit only shows its own (KHR_materials_unlit). Conventions: bsdf_sample.h.
#pragma once

#include "shaders/bsdf_sample.h"

#include <optional>

namespace pluvia {

struct Black {};
struct PreparedBlack {};

inline PreparedBlack prepare(const Black&, Vec3) {
    return {};
}
inline BsdfValue evaluate(const PreparedBlack&, Vec3) {
    return {};
}
inline std::optional<BsdfSample> sample(const PreparedBlack&, float, Vec2) {
    return std::nullopt;
}

}  // namespace pluvia
