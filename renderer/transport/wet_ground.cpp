#include "renderer/transport/wet_ground.h"

#include "renderer/scene/surface_normal.h"
#include "shaders/puddles.h"
#include "shaders/water_film.h"

#include <algorithm>
#include <cmath>

namespace pluvia {
namespace {

float smooth_step(float a, float b, float x) {
    const float t = std::clamp((x - a) / (b - a), 0.0f, 1.0f);
    return t * t * (3 - 2 * t);
}

bool takes_water(const Bsdf& bsdf) {
    return std::holds_alternative<MetallicRoughness>(bsdf) || std::holds_alternative<Layered>(bsdf);
}

/// The direction of an anisotropic base stays where it was while its frame is turned.
void turn_frame(Bsdf& bsdf, Vec3 before, Vec3 after) {
    auto* layered = std::get_if<Layered>(&bsdf);
    auto* base = layered ? &layered->base : std::get_if<MetallicRoughness>(&bsdf);
    if (!base || base->anisotropy.strength == 0) return;
    Vec2& direction = base->anisotropy.direction;
    const Vec3 turned = ShadingBasis(after).to_local(ShadingBasis(before).to_world({direction.x, direction.y, 0}));
    const float length = std::hypot(turned.x, turned.y);
    if (length > 0) direction = {turned.x / length, turned.y / length};
}

/// Film on a face, by the cosine of its normal with the way up: drops hit walls at a glancing angle, and what is below
/// an edge stays dry.
float film_by_slope(float up) {
    return std::clamp((up + 0.25f) / 0.75f, 0.0f, 1.0f);
}

}  // namespace

WetGround::WetGround(const Scene& scene, const RainShadow& shadow, const WetSettings& settings, double time,
                     uint64_t seed)
    : scene_(&scene), shadow_(&shadow), settings_(settings), time_(time), ripples_(settings.ripples_mm_per_h, seed) {}

void WetGround::wet(Surface& s, const SurfacePoint& point, Vec3 direction, Counters& counters) const {
    if (!takes_water(s.bsdf)) return;
    const float up = s.geometric_normal.y;
    const float slope_film = film_by_slope(up);
    if (slope_film == 0) return;
    if (!scene_->materials[scene_->meshes[scene_->instances[point.instance].mesh].material].wet) return;
    const float exposure = shadow_->exposure(s.position + s.geometric_normal * shadow_->clearance(), counters);
    if (exposure == 0) return;

    const Vec3d world = Vec3d(s.position) + scene_->origin;
    const float level = smooth_step(0.94f, 0.985f, up) * smooth_step(0.3f, 0.8f, exposure);
    const Puddle puddle = level > 0 ? puddle_at(world, settings_.puddles) : Puddle();
    WaterCover water;
    water.uneven = std::clamp(ground_noise(world / 1.9), -1.0f, 1.0f);
    // A film that is not closed is patchy: it dries where the ground is high.
    const float w = settings_.wetness;
    const float film = std::clamp(w - 2 * w * (1 - w) * water.uneven, 0.0f, 1.0f);
    water.film = std::max(film * slope_film * exposure, 0.9f * puddle.margin * level);
    water.pool = puddle.depth * level;
    if (!(water.any() > 0)) return;
    counters.count(Feature::wet_surface);

    Vec3 n = s.shading_normal;
    // A film fills part of what a normal map says.
    const float filled = 0.5f * water.film * smooth_step(0.9f, 0.97f, up);
    if (filled > 0) n = normalize(n + (s.geometric_normal - n) * filled);
    if (water.pool > 0) {
        counters.count(Feature::puddle);
        Vec3 surface_of_water(0, 1, 0);
        if (settings_.ripples_mm_per_h > 0) {
            counters.count(Feature::ripples);
            const Vec2 slope = ripples_.slope(world, time_) * water.pool;
            surface_of_water = normalize(Vec3(-slope.x, 1, -slope.y));
        }
        n = normalize(n + (surface_of_water - n) * water.pool);
    }
    n = face(n, -direction);
    s.bsdf = under_water(s.bsdf, water);
    if (auto* layered = std::get_if<Layered>(&s.bsdf); layered && layered->coat_normal != Vec3(0, 0, 1)) {
        // The coat's own normal stays where it was, or lies in the water's surface.
        const Vec3 coat = ShadingBasis(s.shading_normal).to_world(layered->coat_normal);
        layered->coat_normal = ShadingBasis(n).to_local(normalize(coat + (n - coat) * water.any()));
    }
    turn_frame(s.bsdf, s.shading_normal, n);
    s.shading_normal = n;
}

}  // namespace pluvia
