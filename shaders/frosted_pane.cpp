#include "shaders/frosted_pane.h"

#include "renderer/core/sampling.h"
#include "shaders/pane.h"

namespace pluvia {

// Passing light is what a mirror of the same microfacets would reflect, seen in the plane of the sheet: the reflectance
// of sheet and sum of both lobes is then that of the microfacets alone, whose albedo is tabulated.
PreparedFrostedPane prepare(const FrostedPane& pane, Vec3 wo) {
    PreparedFrostedPane seen;
    seen.wo = wo;
    if (wo.z <= 0) return seen;
    const float roughness = std::max(min_roughness, pane.roughness);
    seen.tint = pane.tint;
    seen.ior = pane.ior;
    seen.ggx = Ggx(roughness * roughness);
    seen.view = GgxView(seen.ggx, wo.z);
    seen.albedo = GgxAlbedoRow(roughness);
    seen.lost = std::clamp(seen.albedo.at(std::min(1.0f, wo.z)).lost, 0.0f, 1.0f);
    seen.average_lost = average_ggx_albedo(roughness).lost;
    seen.multiple_reflected = pane_reflectance(2.0f / 3, pane.ior);  // at the mean cosine of diffuse light
    return seen;
}

BsdfValue evaluate(const PreparedFrostedPane& seen, Vec3 wi) {
    if (seen.wo.z <= 0 || wi.z == 0) return {};
    const bool reflected = wi.z > 0;
    const Vec3 mirrored = {wi.x, wi.y, std::abs(wi.z)};
    const float mu_i = std::min(1.0f, mirrored.z);
    const Vec3 h = seen.wo + mirrored;
    const float density = seen.ggx.density(h), cos_h = std::min(1.0f, 0.5f * length(h));
    const float face = pane_reflectance(cos_h, seen.ior), share = reflected ? face : 1 - face;
    const float multiple = reflected ? seen.multiple_reflected : 1 - seen.multiple_reflected;
    const float lost = seen.albedo.at(mu_i).lost;
    const float f = share * density * visibility(seen.ggx, seen.view, mu_i) +
                    multiple * seen.lost * lost / (pi * seen.average_lost);
    return {(reflected ? Rgb(1) : seen.tint) * (f * mu_i),
            (1 - seen.lost) * share * pdf_visible_reflection(seen.view, density) +
                seen.lost * multiple * seen.albedo.pdf_lost_cosine(mu_i) / (2 * pi)};
}

std::optional<BsdfSample> sample(const PreparedFrostedPane& seen, float u_lobe, Vec2 u) {
    if (seen.wo.z <= 0) return std::nullopt;
    Vec3 wi;
    bool passes;
    if (u_lobe < seen.lost) {
        const float mu = seen.albedo.sample_lost_cosine(u.x), r = std::sqrt((1 - mu) * (1 + mu)), phi = 2 * pi * u.y;
        wi = {r * std::cos(phi), r * std::sin(phi), mu};
        passes = u_lobe >= seen.lost * seen.multiple_reflected;
    } else {
        const Vec3 h = sample_visible_normal(seen.ggx, seen.wo, u);
        const float cos_h = std::min(1.0f, dot(seen.wo, h));
        wi = h * (2 * cos_h) - seen.wo;
        if (wi.z <= 0) return std::nullopt;
        passes = (u_lobe - seen.lost) / (1 - seen.lost) >= pane_reflectance(cos_h, seen.ior);
    }
    if (passes) wi.z = -wi.z;
    const BsdfValue value = evaluate(seen, wi);
    if (value.pdf <= 0 || is_black(value.f_cos)) return std::nullopt;
    return BsdfSample{.wi = wi, .weight = value.f_cos / value.pdf, .pdf = value.pdf, .transmitted = passes};
}

}  // namespace pluvia
