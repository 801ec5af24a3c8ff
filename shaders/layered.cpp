#include "shaders/layered.h"

#include "renderer/core/sampling.h"

#include <array>
#include <cmath>

namespace pluvia {
namespace {

/// Gauss-Legendre on [0, 1], exact to degree 11: Schlick's terms of two interfaces under a cosine.
constexpr std::array<float, 6> nodes = {0.03376524f, 0.16939531f, 0.38069041f, 0.61930959f, 0.83060469f, 0.96623476f};
constexpr std::array<float, 6> weights = {0.08566225f, 0.18038079f, 0.23395697f, 0.23395697f, 0.18038079f, 0.08566225f};

/// Mean over azimuths.
float base_passed(const PreparedMetallicRoughness& base, float mu) {
    if (base.lambert) return 1;
    if (!base.anisotropic.used()) return base.coat_passed(base.albedo.at(mu));
    constexpr int azimuths = 8;
    const float sine = std::sqrt((1 - mu) * (1 + mu));
    float sum = 0;
    for (int i = 0; i < azimuths; ++i) {
        const float phi = pi * (float(i) + 0.5f) / azimuths;
        sum += base.coat_passed(base.anisotropic.albedo({sine * std::cos(phi), sine * std::sin(phi), mu}));
    }
    return sum / azimuths;
}

/// What the diffuse base must be scaled by when the coat's transmittances to wo and wi multiply it, so that together
/// with both reflections it returns all: as under a single dielectric (metallic_roughness.cpp), with the product of
/// both transmittances in place of one. The base's own normalisation is taken back.
float diffuse_scale(const PreparedLayered& seen) {
    float both = 0, base = 0;
    for (size_t i = 0; i < nodes.size(); ++i) {
        const float mu = nodes[i], passed = 2 * mu * weights[i] * base_passed(seen.base, mu);
        base += passed;
        both += passed * seen.coat.coat_passed(seen.coat.albedo.at(mu));
    }
    return both > 0 ? base / both : 0;
}

void prepare_coat(const Layered& material, Vec3 wo, PreparedLayered& seen) {
    seen.coat_basis = ShadingBasis(material.coat_normal);
    const Vec3 coat_wo = seen.coat_basis.to_local(wo);
    if (material.coat == 0 || coat_wo.z <= 0) return;
    seen.has_coat = true;
    seen.tilted = material.coat_normal != Vec3(0, 0, 1);
    seen.coat = prepare(MetallicRoughness{.base_color = Rgb(0),
                                          .metallic = 0,
                                          .roughness = material.coat_roughness,
                                          .specular = material.coat,
                                          .specular_color = Rgb(1),
                                          .ior = material.coat_ior},
                        coat_wo);
    seen.coat_passed = seen.coat.coat_passed(seen.coat.albedo.at(coat_wo.z));
    seen.diffuse_scale = seen.tilted ? 1 : seen.coat_passed * diffuse_scale(seen);
}

void prepare_sheen(const Sheen& sheen, float mu, PreparedLayered& seen) {
    seen.sheen_color = sheen.color;
    seen.sheen_weight = max_component(sheen.color);
    if (seen.sheen_weight == 0) return;
    seen.sheen_roughness = std::max(min_sheen_roughness, sheen.roughness);
    seen.sheen_alpha = seen.sheen_roughness * seen.sheen_roughness;
    seen.sheen_passed = 1 - seen.sheen_weight * sheen_albedo(std::min(1.0f, mu), seen.sheen_roughness);
}

}  // namespace

PreparedLayered prepare(const Layered& material, Vec3 wo) {
    PreparedLayered seen;
    seen.base = prepare(material.base, wo);
    if (wo.z <= 0) return seen;
    prepare_coat(material, wo, seen);
    prepare_sheen(material.sheen, wo.z, seen);
    const float coat = 1 - seen.coat_passed, sheen = seen.coat_passed * (1 - seen.sheen_passed);
    const float base = seen.coat_passed * seen.sheen_passed * seen.base.reflected;
    const float total = coat + sheen + base;
    if (total > 0) {
        seen.coat_chance = coat / total;
        seen.sheen_chance = sheen / total;
    }
    return seen;
}

BsdfValue evaluate(const PreparedLayered& seen, Vec3 wi) {
    if (seen.base.wo.z <= 0 || wi.z <= 0) return {};
    const MetallicRoughnessParts base = evaluate_parts(seen.base, wi);
    BsdfValue value;
    float under_coat = 1, diffuse = 1;
    if (seen.has_coat) {
        const Vec3 coat_wi = seen.coat_basis.to_local(wi);
        if (coat_wi.z > 0) value = evaluate(seen.coat, coat_wi);
        const float passed = seen.coat.coat_passed(seen.coat.albedo.at(std::max(0.0f, coat_wi.z)));
        under_coat = std::min(seen.coat_passed, passed);
        diffuse = seen.tilted ? under_coat : seen.diffuse_scale * passed;
        value.pdf *= seen.coat_chance;
    }
    float under_sheen = 1;
    if (seen.sheen_weight > 0) {
        const float passed = 1 - seen.sheen_weight * sheen_albedo(std::min(1.0f, wi.z), seen.sheen_roughness);
        under_sheen = std::min(seen.sheen_passed, passed);
        const float f = sheen_reflectance(seen.sheen_alpha, seen.base.wo, wi);
        value.f_cos += seen.sheen_color * (f * wi.z * under_coat);
        value.pdf += seen.sheen_chance / (2 * pi);
    }
    value.f_cos += base.specular * (under_coat * under_sheen) + base.diffuse * (diffuse * under_sheen);
    value.pdf += (1 - seen.coat_chance - seen.sheen_chance) * base.pdf;
    return value;
}

std::optional<BsdfSample> sample(const PreparedLayered& seen, float u_lobe, Vec2 u) {
    if (seen.base.wo.z <= 0) return std::nullopt;
    Vec3 wi;
    if (u_lobe < seen.coat_chance) {
        const Vec3 coat_wi = sample_direction(seen.coat, u_lobe / seen.coat_chance, u);
        if (coat_wi.z <= 0) return std::nullopt;  // the pdf counts the coat's lobe above the coat alone
        wi = seen.coat_basis.to_world(coat_wi);
    } else if (u_lobe < seen.coat_chance + seen.sheen_chance) {
        const float r = std::sqrt(1 - u.x * u.x), phi = 2 * pi * u.y;
        wi = {r * std::cos(phi), r * std::sin(phi), u.x};
    } else {
        const float above = seen.coat_chance + seen.sheen_chance;
        wi = sample_direction(seen.base, std::min((u_lobe - above) / (1 - above), 1 - 0x1p-24f), u);
    }
    const BsdfValue value = evaluate(seen, wi);
    if (value.pdf <= 0 || is_black(value.f_cos)) return std::nullopt;
    return BsdfSample{.wi = wi, .weight = value.f_cos / value.pdf, .pdf = value.pdf};
}

}  // namespace pluvia
