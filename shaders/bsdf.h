// Bsdf: how a surface scatters light at one point, as the closed set of models that scenes use.
// Conventions: bsdf_sample.h; the models: metallic_roughness.h, layered.h, pane.h, frosted_pane.h, glass.h,
// black.h.
//
// A path prepares the Bsdf of a hit once for its wo, then samples it and evaluates it for each light:
//     const PreparedBsdf bsdf = prepare(material, wo);
//     const BsdfValue towards_light = evaluate(bsdf, wi);
//     const std::optional<BsdfSample> next = sample(bsdf, u_lobe, u);
#pragma once

#include "shaders/black.h"
#include "shaders/bsdf_sample.h"
#include "shaders/frosted_pane.h"
#include "shaders/glass.h"
#include "shaders/layered.h"
#include "shaders/metallic_roughness.h"
#include "shaders/pane.h"

#include <optional>
#include <variant>

namespace pluvia {

using Bsdf = std::variant<MetallicRoughness, Pane, Layered, FrostedPane, Glass, Black>;
using PreparedBsdf = std::variant<PreparedMetallicRoughness, PreparedPane, PreparedLayered, PreparedFrostedPane,
                                  PreparedGlass, PreparedBlack>;

/// True where sampling lights is in vain: all lobes are deltas, or there are none.
inline bool is_delta(const PreparedBsdf& bsdf) {
    const auto* glass = std::get_if<PreparedGlass>(&bsdf);
    return std::holds_alternative<PreparedPane>(bsdf) || std::holds_alternative<PreparedBlack>(bsdf) ||
           (glass && glass->smooth);
}

/// True where light from below the surface may arrive through a lobe that is no delta.
inline bool is_translucent(const PreparedBsdf& bsdf) {
    return std::holds_alternative<PreparedFrostedPane>(bsdf) || std::holds_alternative<PreparedGlass>(bsdf);
}

/// True where light that is let through goes straight on, so that light samples see through.
inline bool lets_straight_through(const Bsdf& bsdf) {
    return std::holds_alternative<Pane>(bsdf);
}

/// Computes what depends on wo alone.
inline PreparedBsdf prepare(const Bsdf& bsdf, Vec3 wo) {
    return std::visit([&](const auto& model) -> PreparedBsdf { return prepare(model, wo); }, bsdf);
}

/// f |cos theta_i| and the pdf of sample() for wi; zero for delta lobes and where a direction is below the surface.
inline BsdfValue evaluate(const PreparedBsdf& bsdf, Vec3 wi) {
    return std::visit([&](const auto& model) { return evaluate(model, wi); }, bsdf);
}

/// Draws wi about in proportion to f |cos theta_i|. Empty: the path ends here.
/// u_lobe and u: uniform in [0, 1), independent.
inline std::optional<BsdfSample> sample(const PreparedBsdf& bsdf, float u_lobe, Vec2 u) {
    return std::visit([&](const auto& model) { return sample(model, u_lobe, u); }, bsdf);
}

/// The same for a caller that asks only once per wo.
inline BsdfValue evaluate(const Bsdf& bsdf, Vec3 wo, Vec3 wi) {
    return evaluate(prepare(bsdf, wo), wi);
}
inline std::optional<BsdfSample> sample(const Bsdf& bsdf, Vec3 wo, float u_lobe, Vec2 u) {
    return sample(prepare(bsdf, wo), u_lobe, u);
}

}  // namespace pluvia
