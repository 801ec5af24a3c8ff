// How something in the air turns light towards the camera, as a density over directions that can be evaluated and
// sampled: rain finer than streaks, fog, and drops as streaks.
#pragma once

#include "renderer/rain/rain_medium.h"
#include "shaders/drop_lens.h"
#include "shaders/fog.h"
#include "shaders/raindrop.h"
#include "shaders/streak_textures.h"

#include <variant>

namespace pluvia {

/// value: of the function, 1/sr; pdf: with which sample_scatter draws the direction, 1/sr.
struct ScatterValue {
    float value, pdf;
};

/// direction: of the camera's ray, unit. wi: where the light comes from, unit.
struct DropScatter {
    Vec3 direction;

    ScatterValue evaluate(Vec3 wi) const {
        const float p = drop_phase(dot(wi, direction));
        return {p, p};
    }
    Vec3 sample(Vec2 u) const { return sample_drop_phase(direction, u); }
};

struct FogScatter {
    Vec3 direction;

    ScatterValue evaluate(Vec3 wi) const {
        const float p = fog_phase(dot(wi, direction));
        return {p, p};
    }
    Vec3 sample(Vec2 u) const { return sample_fog_phase(direction, u); }
};

/// A drop with the texture of a streak on it. Its mean over the streak is the phase function.
struct TexturedScatter {
    Vec3 direction;
    const StreakTextures* textures;
    StreakPlace place;

    ScatterValue evaluate(Vec3 wi) const {
        const float p = drop_phase(dot(wi, direction));
        return {p * textures->brightness(place, wi), p};
    }
    Vec3 sample(Vec2 u) const { return sample_drop_phase(direction, u); }
};

/// A drop that is looked into.
struct LensScatter {
    DropLens lens;

    ScatterValue evaluate(Vec3 wi) const {
        const float p = lens.evaluate(wi);
        return {p, p};
    }
    Vec3 sample(Vec2 u) const { return lens.sample(u); }
};

using ScatterFunction = std::variant<DropScatter, FogScatter, TexturedScatter, LensScatter>;

inline ScatterValue evaluate_scatter(const ScatterFunction& function, Vec3 wi) {
    return std::visit([&](const auto& f) { return f.evaluate(wi); }, function);
}
inline Vec3 sample_scatter(const ScatterFunction& function, Vec2 u) {
    return std::visit([&](const auto& f) { return f.sample(u); }, function);
}
/// Of the medium's kinds.
inline ScatterFunction scatter_function(Scatterer scatterer, Vec3 direction) {
    if (scatterer == Scatterer::fog) return FogScatter{direction};
    return DropScatter{direction};
}

}  // namespace pluvia
