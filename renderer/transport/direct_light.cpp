#include "renderer/transport/direct_light.h"

#include "renderer/transport/media.h"
#include "renderer/transport/sky_guide.h"

#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace pluvia {
namespace {

// Shadow rays stop a little before the light, so that an emissive triangle does not shade itself. Relative, because
// both ends carry the rounding of the distance.
constexpr float before_light = 1 - 2e-4f;

constexpr uint64_t roulette_domain = 0x726f756c;

/// Samples of the sky at a vertex, each with its shadow ray. A second takes a quarter of the squared error from streets
/// by day for a fifth of the time; where lamps shine brighter the noise is theirs.
int sky_samples(const Lights& lights) {
    return lights.lamps_outshine_sky() ? 1 : 2;
}

/// Point i of a few that share one random point: its shift on the torus by the sequence R2 (Roberts 2018).
Vec2 shifted(Vec2 u, int i) {
    const auto wrap = [](float x) { return std::min(x - std::floor(x), 0x1.fffffep-1f); };
    return {wrap(u.x + float(i) * 0.754877666f), wrap(u.y + float(i) * 0.569840291f)};
}

bool is_above(const Surface& surface, Vec3 wi) {
    return dot(wi, surface.geometric_normal) > 0;
}

/// Of all samples drawn so far one, kept with a probability in proportion to what it would bring if it were visible.
class Pick {
public:
    explicit Pick(float u) : u_(u) {}

    /// count: samples drawn of this kind. Whether it is the one that is kept.
    bool add(const Vertex& v, const LightSample& light, int count) {
        const bool above = is_above(v.surface, light.wi);
        if (is_black(light.radiance) || (!above && !is_translucent(v.bsdf))) return false;
        const Vec3 wi = v.basis.to_local(light.wi);
        if ((wi.z > 0) != above) return false;  // as for the directions that a path samples
        const BsdfValue value = evaluate(v.bsdf, wi);
        const float expected = float(count) * light.pdf;
        const float mis = light.delta ? 1.0f : power_heuristic(expected, value.pdf);
        Rgb scattered = value.f_cos * (mis / expected);
        if (const int medium = above ? v.surface.before : v.surface.behind; medium >= 0)
            scattered *= transmittance(v.scene, medium, light.distance) * basic_radiance(v.scene, medium);
        const float weight = luminance(scattered * light.radiance);
        if (!(weight > 0)) return false;
        total_ += weight;
        const float share = weight / total_;
        if (u_ >= share) {
            u_ = (u_ - share) / (1 - share);
            return false;
        }
        light_ = light;
        scattered_ = scattered * (1 / weight);
        u_ = u_ / share;
        return true;
    }
    const std::optional<LightSample>& light() const { return light_; }
    /// Luminance of the sum of all samples, as far as they are visible like the kept one.
    float expected() const { return total_; }
    /// Unbiased estimate of that sum. radiance: of the kept sample, which it may have been weighed without knowing.
    Rgb estimate(Rgb radiance) const { return scattered_ * radiance * total_; }

private:
    float u_, total_ = 0;
    Rgb scattered_;  // share of the light that reaches the eye, over the weight
    std::optional<LightSample> light_;
};

/// radiance: gives that of the kept sample. It is asked for only where it arrives: textures and skies are large.
template <class Radiance>
Rgb visible_part(const RayScene& ray_scene, const Pick& pick, const Vertex& v, uint64_t key, const Radiance& radiance,
                 Counters& counters) {
    if (!pick.light()) return Rgb(0);
    const float weight = shadow_ray_weight(pick.expected(), v.relevance, key);
    if (weight == 0) return Rgb(0);
    const Vec3 n = v.surface.geometric_normal;
    const Vec3 from =
        offset_from_surface(v.surface.position, is_above(v.surface, pick.light()->wi) ? n : -n, v.surface.extent);
    // Aimed anew from where the ray starts: a ray that keeps its direction while its origin moves off the surface meets
    // a triangle seen edge-on so much earlier that the triangle would shade itself.
    LightSample light = *pick.light();
    if (std::isfinite(light.distance)) {
        const Vec3 to_light = v.surface.position + light.wi * light.distance - from;
        light.distance = length(to_light);
        light.wi = to_light / light.distance;
    }
    const Rgb share = visible_share(ray_scene, from, light, {key}, counters);
    return is_black(share) ? share : pick.estimate(radiance()) * share * weight;
}

/// What is left of light that goes straight on through all that the ray meets.
Rgb through_panes(const RayScene& ray_scene, Ray ray, OpacityTest opacity, Counters& counters) {
    Rgb left(1);
    RayHit hit;
    while (!is_black(left) && ray_scene.closest_hit(ray, opacity, hit, counters)) {
        const Surface surface = evaluate_surface(ray_scene.scene(), hit.point, ray.direction, 0, counters);
        left *= straight_transmittance(ray_scene.scene(), hit.point, surface, ray.direction, counters);
        ray = {offset_from_surface(surface.position, -surface.geometric_normal, surface.extent), ray.direction,
               ray.t_max - hit.distance};
    }
    return left;
}

}  // namespace

float shadow_ray_weight(float expected, float relevance, uint64_t key) {
    const float q = expected * relevance;
    if (!(q < 1)) return 1;
    // A hash rather than one of the sampler's numbers: the relevance depends on samples that those are stratified with.
    return unit_float(hash_key(key, roulette_domain)) < q ? 1 / q : 0;
}

Rgb visible_share(const RayScene& ray_scene, Vec3 from, const LightSample& light, OpacityTest opacity,
                  Counters& counters) {
    const Ray ray{from, light.wi, light.distance * before_light};
    switch (ray_scene.obstruction(ray, opacity, counters)) {
        case Obstruction::none:
            return Rgb(1);
        case Obstruction::panes:
            return through_panes(ray_scene, ray, opacity, counters);
        default:
            return Rgb(0);
    }
}

Rgb distant_light(const Lights& lights, const SkyGuide* guide, const RayOrigin& origin, Vec3 direction) {
    const EnvironmentSample sky = lights.environment().sky(direction), sun = lights.environment().sun(direction);
    if (!(origin.pdf > 0)) return sky.radiance + sun.radiance;
    if (!origin.parts_sky_and_sun)
        return (sky.radiance + sun.radiance) * power_heuristic(origin.pdf, lights.pdf_distant(direction));
    const float sky_pdf = guide ? guide->pdf(origin.receiver, sky) : sky.pdf;
    return sky.radiance * power_heuristic(origin.pdf, float(sky_samples(lights)) * sky_pdf) +
           sun.radiance * power_heuristic(origin.pdf, lights.pdf_sun(sun));
}

Rgb direct_light(const RayScene& ray_scene, const Lights& lights, const SkyGuide* guide, const Vertex& v,
                 Counters& counters) {
    Rgb sum;
    const Vec2 choice = v.u.get_2d(Draw::light_choice);
    const Receiver receiver = receiver_at(v.surface, v.bsdf);
    const auto key = [&](Draw draw) { return v.sampler.key(draw, uint32_t(v.bounce)); };
    if (lights.has_local()) {
        counters.count(Feature::local_light);
        Pick pick(v.u.get_1d(Draw::light_pick));
        const int count = v.light_samples;
        std::array<Lights::LocalPoint, most_light_samples> points;
        lights.choose_local(receiver, choice.x, {points.data(), size_t(count)});
        const Lights::LocalPoint* kept = nullptr;
        for (int i = 0; i < count; ++i) {
            if (points[i].light < 0) continue;
            points[i].u = shifted(v.u.get_2d(Draw::light_point), i);
            if (pick.add(v, lights.estimate(receiver.position, points[i]), count)) kept = &points[i];
        }
        const auto radiance = [&] { return lights.illuminate(receiver.position, *kept).radiance; };
        sum += visible_part(ray_scene, pick, v, key(Draw::light_point), radiance, counters);
    }
    if (lights.has_sky() || lights.has_sun()) counters.count(Feature::distant_light);
    if (lights.has_sky()) {
        const int count = sky_samples(lights);
        for (int i = 0; i < count; ++i) {
            Pick pick(0);
            const Vec2 u = shifted(v.u.get_2d(Draw::sky_point), i);
            const EnvironmentSample sky =
                guide ? guide->estimate(receiver, u, counters) : lights.environment().estimate_sky(u);
            const LightSample light{sky.wi, std::numeric_limits<float>::infinity(), sky.radiance, sky.pdf, false};
            pick.add(v, light, count);
            const auto radiance = [&] { return lights.environment().sky(light.wi).radiance; };
            sum += visible_part(ray_scene, pick, v, hash_key(key(Draw::sky_point), uint64_t(i)), radiance, counters);
        }
    }
    if (lights.has_sun()) {
        Pick pick(0);
        const LightSample light = lights.sample_sun(choice.y, v.u.get_2d(Draw::sun_point));
        pick.add(v, light, 1);
        sum += visible_part(
            ray_scene, pick, v, key(Draw::sun_point), [&] { return light.radiance; }, counters);
    }
    return sum;
}

}  // namespace pluvia
