#include "renderer/transport/path.h"

#include "renderer/core/sampling.h"

namespace pluvia {
namespace {

// Shadow rays stop a little before the light, so that an emissive triangle does not shade itself. Relative, because
// both ends carry the rounding of the distance.
constexpr float before_light = 1 - 2e-4f;

// Paths live at least this long, then survive with the probability of their throughput.
constexpr int first_roulette_bounce = 2;
constexpr float max_survival = 0.95f;  // below 1, so that a closed white room cannot hold a path for ever

}  // namespace

bool PathTracer::is_visible(Vec3 from, const LightSample& light, OpacityTest opacity, Counters& counters) const {
    return !ray_scene_->occluded({from, light.wi, light.distance * before_light}, opacity, counters);
}

Rgb PathTracer::weigh(const LightSample& light, const Surface& surface, const PreparedBsdf& bsdf,
                      const ShadingBasis& basis, OpacityTest opacity, Counters& counters) const {
    if (is_black(light.radiance) || dot(light.wi, surface.geometric_normal) <= 0) return Rgb(0);
    const BsdfValue value = evaluate(bsdf, basis.to_local(light.wi));
    if (is_black(value.f_cos)) return Rgb(0);
    const Vec3 from = offset_from_surface(surface.position, surface.geometric_normal);
    if (!is_visible(from, light, opacity, counters)) return Rgb(0);
    const float mis = light.delta ? 1.0f : power_heuristic(light.pdf, value.pdf);
    return value.f_cos * light.radiance * (mis / light.pdf);
}

Rgb PathTracer::sample_lights(const Surface& surface, const PreparedBsdf& bsdf, const ShadingBasis& basis,
                              const Sampler& sampler, const VertexNumbers& u, int bounce, Counters& counters) const {
    Rgb sum;
    const Vec2 choice = u.get_2d(Draw::light_choice);
    if (lights_->has_local()) {
        counters.count(Feature::local_light);
        const Receiver receiver{surface.position, surface.shading_normal};
        if (const auto light = lights_->sample_local(receiver, choice.x, u.get_2d(Draw::light_point)))
            sum += weigh(*light, surface, bsdf, basis, {sampler.key(Draw::light_point, bounce)}, counters);
    }
    if (lights_->has_distant()) {
        counters.count(Feature::distant_light);
        if (const auto light = lights_->sample_distant(choice.y, u.get_2d(Draw::sky_point)))
            sum += weigh(*light, surface, bsdf, basis, {sampler.key(Draw::sky_point, bounce)}, counters);
    }
    return sum;
}

PathResult PathTracer::trace(Ray ray, RayOrigin origin, const Sampler& sampler, int bounce, Counters& counters) const {
    PathResult result;
    Rgb throughput(1);
    const int first_bounce = bounce;
    for (;; ++bounce) {
        RayHit hit;
        if (!ray_scene_->closest_hit(ray, {sampler.key(Draw::opacity, bounce)}, hit, counters)) {
            if (lights_->environment().is_black()) return result;
            counters.count(Feature::environment);
            const float mis = origin.pdf > 0 ? power_heuristic(origin.pdf, lights_->pdf_distant(ray.direction)) : 1.0f;
            result.radiance += throughput * lights_->environment().radiance(ray.direction) * mis;
            return result;
        }
        if (bounce == first_bounce) result.distance = hit.distance;
        const VertexNumbers u = sampler.vertex(bounce);
        const Vec2 lobe = u.get_2d(Draw::lobe);
        const Surface surface = evaluate_surface(*scene_, hit.point, ray.direction, lobe.y, counters);
        if (!is_black(surface.emission)) {
            const float mis =
                origin.pdf > 0 ? power_heuristic(origin.pdf, lights_->pdf_local(origin.receiver, hit.point)) : 1.0f;
            result.radiance += throughput * surface.emission * mis;
        }
        if (bounce >= settings_.max_bounces) return result;

        const ShadingBasis basis(surface.shading_normal);
        const PreparedBsdf bsdf = prepare(surface.bsdf, basis.to_local(-ray.direction));
        if (!is_delta(bsdf))
            result.radiance += throughput * sample_lights(surface, bsdf, basis, sampler, u, bounce, counters);

        const auto next = sample(bsdf, lobe.x, u.get_2d(Draw::bsdf));
        if (!next) return result;
        const Vec3 wi = basis.to_world(next->wi);
        // A direction above the shading normal's horizon may still enter the surface.
        if ((dot(wi, surface.geometric_normal) > 0) == next->transmitted) return result;
        throughput *= next->weight;
        if (is_black(throughput)) return result;
        if (bounce >= first_roulette_bounce) {
            const float survival = std::min(max_survival, max_component(throughput));
            if (u.get_1d(Draw::roulette) >= survival) return result;
            throughput *= 1 / survival;
        }
        origin = {next->delta ? 0.0f : next->pdf, {surface.position, surface.shading_normal}};
        const Vec3 side = next->transmitted ? -surface.geometric_normal : surface.geometric_normal;
        ray = {offset_from_surface(surface.position, side), wi};
    }
}

}  // namespace pluvia
