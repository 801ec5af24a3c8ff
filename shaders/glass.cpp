#include "shaders/glass.h"

#include "renderer/core/sampling.h"

#include <array>
#include <map>
#include <memory>
#include <mutex>
#include <shared_mutex>
#include <vector>

namespace pluvia {
namespace {

constexpr int rows = 24;  // even in perceptual roughness

float roughness_of(int row) {
    return min_roughness + (1 - min_roughness) * float(row) / (rows - 1);
}

/// Masking and shadowing over masking alone, G2 / G1(wo).
float shadowing(const Ggx& ggx, const GgxView& view, float mu_i) {
    return visibility(ggx, view, mu_i) * mu_i * 2 * (view.mu + view.root);
}

/// Over the visible normals of wo, as in microfacet.cpp; times ((mu + alpha) / alpha)^2, which varies slowly.
float integrate_loss(float mu, float roughness, float eta) {
    constexpr int azimuths = 24, heights = 64;
    const float alpha = roughness * roughness;
    const Ggx ggx(alpha);
    const GgxView view(ggx, mu);
    const Vec3 wo = {std::sqrt(std::max(0.0f, 1 - mu * mu)), 0, mu};
    double lost = 0, total = 0;
    for (int j = 0; j < heights; ++j) {
        // Even steps x give the heights x^3 (10 - 15 x + 6 x^2); see microfacet.cpp.
        const float x = (float(j) + 0.5f) / heights, weight = x * x * (1 - x) * (1 - x);
        const float height = x * x * x * (10 - 15 * x + 6 * x * x);
        for (int k = 0; k < azimuths; ++k) {
            const Vec3 h = sample_visible_normal(ggx, wo, {(float(k) + 0.5f) / azimuths, 1 - height});
            const float cos_h = std::min(1.0f, dot(wo, h));
            const float reflectance = fresnel_dielectric(cos_h, eta).mean();
            const float mu_r = 2 * cos_h * h.z - mu;
            float returned = mu_r > 0 ? reflectance * shadowing(ggx, view, mu_r) : 0;
            if (const auto wi = refract(wo, h, eta); wi && wi->z < 0)
                returned += (1 - reflectance) * shadowing(ggx, view, -wi->z);
            lost += weight * (1 - returned);
            total += weight;
        }
    }
    const double sum = (mu + alpha) / alpha;
    return float(lost / total * sum * sum);
}

/// Losses from the side whose view of the index is eta, and their cosine-weighted means for each row.
struct LossTable {
    std::vector<float> losses, averages;

    explicit LossTable(float eta) {
        for (int row = 0; row < rows; ++row) {
            const float roughness = roughness_of(row), alpha = roughness * roughness;
            for (int column = 0; column < GlassLoss::columns; ++column) {
                const float x = float(column) / (GlassLoss::columns - 1), ratio = x * x / (1 + alpha);
                const float mu = std::clamp(alpha * ratio / (1 - ratio), 1e-6f, 1.0f);
                losses.push_back(integrate_loss(mu, roughness, eta));
            }
        }
    }
};

struct Tables {
    LossTable near_side, far_side;
    explicit Tables(float eta) : near_side(eta), far_side(1 / eta) {}
};

const Tables& tables(float eta) {
    static std::shared_mutex mutex;
    static std::map<float, std::unique_ptr<const Tables>> known;
    {
        const std::shared_lock lock(mutex);
        if (const auto found = known.find(eta); found != known.end()) return *found->second;
    }
    const std::unique_lock lock(mutex);
    auto& entry = known[eta];
    if (!entry) entry = std::make_unique<const Tables>(eta);
    return *entry;
}

/// Unit normal of the microfacet that sends light from wi to wo, above the surface.
Vec3 half_vector(Vec3 wo, Vec3 wi, float eta) {
    const Vec3 h = wi.z > 0 ? wo + wi : wo + wi * eta;
    return normalize(h.z < 0 ? -h : h);
}

}  // namespace

GlassLoss::GlassLoss(float eta, float roughness) : alpha_(roughness * roughness) {
    const Tables& table = tables(eta);
    const float y = (roughness - min_roughness) * (float(rows - 1) / (1 - min_roughness));
    const int row = std::clamp(int(y), 0, rows - 2);
    row_offset_ = y - float(row);
    column_scale_ = std::sqrt(1 + alpha_) * float(columns - 1);
    lower_[0] = &table.near_side.losses[size_t(row) * columns];
    lower_[1] = &table.far_side.losses[size_t(row) * columns];
    // Of the interpolated table, even in log(mu + alpha): only so does a lobe divided by its mean integrate to it.
    constexpr int steps = 24;
    const float range = std::log(1 + 1 / alpha_);
    for (int side = 0; side < 2; ++side)
        for (int i = 0; i < steps; ++i) {
            const float mu = alpha_ * std::expm1(range * (float(i) + 0.5f) / steps);
            average_[side] += at(side, mu) * 2 * mu * (mu + alpha_) * range / steps;
        }
}

float GlassLoss::at(int side, float mu) const {
    const float inverse = 1 / (mu + alpha_), smooth = alpha_ * inverse;
    const float x = std::sqrt(mu * inverse) * column_scale_;
    const int column = std::clamp(int(x), 0, columns - 2);
    const float tx = x - float(column);
    const float *a = lower_[side] + column, *b = a + columns;
    const float low = a[0] + tx * (a[1] - a[0]), high = b[0] + tx * (b[1] - b[0]);
    return smooth * smooth * (low + row_offset_ * (high - low));
}

PreparedGlass prepare(const Glass& glass, Vec3 wo) {
    PreparedGlass seen;
    seen.wo = wo;
    seen.tint = glass.tint;
    seen.eta = glass.eta;
    // Without a difference of indices nothing is bent, and no microfacet is found by how light was bent.
    seen.smooth = glass.roughness <= min_roughness || std::abs(glass.eta - 1) < 1e-3f;
    if (wo.z <= 0) return seen;
    if (seen.smooth) {
        seen.reflectance = fresnel_dielectric(std::min(1.0f, wo.z), glass.eta).mean();
        return seen;
    }
    seen.ggx = Ggx(glass.roughness * glass.roughness);
    seen.view = GgxView(seen.ggx, wo.z);
    seen.row = GgxAlbedoRow(glass.roughness);
    seen.loss = GlassLoss(glass.eta, glass.roughness);
    seen.lost = std::clamp(seen.loss.near_side(std::min(1.0f, wo.z)), 0.0f, 1.0f);
    const float near = seen.loss.near_average(), far = glass.eta * glass.eta * seen.loss.far_average();
    seen.multiple_passed = far / (near + far);
    return seen;
}

BsdfValue evaluate(const PreparedGlass& seen, Vec3 wi) {
    if (seen.smooth || seen.wo.z <= 0 || wi.z == 0) return {};
    const bool reflected = wi.z > 0;
    const float mu_i = std::min(1.0f, std::abs(wi.z));
    const Rgb color = reflected ? Rgb(1) : seen.tint;

    // Multiple scattering.
    const float share = reflected ? 1 - seen.multiple_passed : seen.multiple_passed;
    const float loss_i = reflected ? seen.loss.near_side(mu_i) : seen.loss.far_side(mu_i);
    const float average = reflected ? seen.loss.near_average() : seen.loss.far_average();
    float f_cos = share * seen.lost * loss_i * mu_i / (pi * average);
    float pdf = seen.lost * share * seen.row.pdf_lost_cosine(mu_i) / (2 * pi);

    const Vec3 h = half_vector(seen.wo, wi, seen.eta);
    const float cos_o = dot(seen.wo, h), cos_i = dot(wi, h);
    if (cos_o > 0 && (cos_i > 0) == reflected) {
        const float density = seen.ggx.density(h),
                    reflectance = fresnel_dielectric(std::min(1.0f, cos_o), seen.eta).mean();
        float single = visibility(seen.ggx, seen.view, mu_i) * mu_i * density,
              visible = pdf_visible_reflection(seen.view, density);
        if (reflected) {
            single *= reflectance, visible *= reflectance;
        } else {
            const float root = seen.eta * cos_i + cos_o;
            const float jacobian = 4 * cos_o * std::abs(cos_i) * (seen.eta * seen.eta) / (root * root);
            single *= (1 - reflectance) * jacobian, visible *= (1 - reflectance) * jacobian;
        }
        f_cos += single;
        pdf += (1 - seen.lost) * visible;
    }
    return {color * f_cos, pdf};
}

std::optional<BsdfSample> sample(const PreparedGlass& seen, float u_lobe, Vec2 u) {
    if (seen.wo.z <= 0) return std::nullopt;
    if (seen.smooth) {
        if (u_lobe < seen.reflectance)
            return BsdfSample{.wi = {-seen.wo.x, -seen.wo.y, seen.wo.z}, .weight = Rgb(1), .delta = true};
        const auto wi = refract(seen.wo, {0, 0, 1}, seen.eta);
        if (!wi) return std::nullopt;  // total reflection in rounding
        return BsdfSample{.wi = *wi, .weight = seen.tint, .delta = true, .transmitted = true};
    }
    Vec3 wi;
    if (u_lobe < seen.lost) {
        const bool passes = u_lobe < seen.lost * seen.multiple_passed;
        const float mu = seen.row.sample_lost_cosine(u.x), r = std::sqrt((1 - mu) * (1 + mu)), phi = 2 * pi * u.y;
        wi = {r * std::cos(phi), r * std::sin(phi), passes ? -mu : mu};
    } else {
        const Vec3 h = sample_visible_normal(seen.ggx, seen.wo, u);
        const float cos_h = std::min(1.0f, dot(seen.wo, h));
        const float chance = (u_lobe - seen.lost) / (1 - seen.lost);
        if (chance < fresnel_dielectric(cos_h, seen.eta).mean()) {
            wi = h * (2 * cos_h) - seen.wo;
            if (wi.z <= 0) return std::nullopt;
        } else {
            const auto refracted = refract(seen.wo, h, seen.eta);
            if (!refracted || refracted->z >= 0) return std::nullopt;
            wi = *refracted;
        }
    }
    const BsdfValue value = evaluate(seen, wi);
    if (value.pdf <= 0 || is_black(value.f_cos)) return std::nullopt;
    return BsdfSample{.wi = wi, .weight = value.f_cos / value.pdf, .pdf = value.pdf, .transmitted = wi.z < 0};
}

}  // namespace pluvia
