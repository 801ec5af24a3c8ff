#include "renderer/transport/path.h"

#include "renderer/core/sampling.h"
#include "renderer/transport/media.h"

namespace pluvia {
namespace {

// Below 1, so that a closed white room cannot hold a path for ever. Where albedos are a, the square of what a path
// gathers has a finite mean only while a^2 < max_survival: 0.95 would lose rooms whiter than 0.975 in noise.
constexpr float max_survival = 0.999f;

}  // namespace

PathResult PathTracer::trace(Ray ray, RayOrigin origin, const Sampler& sampler, int bounce, Counters& counters,
                             const PathWorth& worth) const {
    PathResult result;
    Rgb throughput(1);  // of basic radiance: see shaders/glass.h
    Media media;
    const int first_bounce = bounce;
    int straight = 0;  // panes passed on the way: no scattering events, as they are none for light samples
    for (;; ++bounce) {
        RayHit hit;
        if (!ray_scene_->closest_hit(ray, {sampler.key(Draw::opacity, bounce)}, hit, counters)) {
            if (lights_->environment().is_black()) return result;
            counters.count(Feature::environment);
            result.radiance += throughput * distant_light(*lights_, sky_guide_, origin, ray.direction);
            return result;
        }
        if (bounce == first_bounce) result.distance = hit.distance, result.first = hit.point;
        const VertexNumbers u = sampler.vertex(bounce);
        const Vec2 lobe = u.get_2d(Draw::lobe);
        Surface surface = evaluate_surface(*scene_, hit.point, ray.direction, lobe.y, counters);
        if (wet_ground_) wet_ground_->wet(surface, hit.point, ray.direction, counters);
        if (surface.volume >= 0 || !media.empty()) {
            counters.count(Feature::volume);
            find_sides(*scene_, media, surface);
            throughput *= transmittance(*scene_, surface.before, hit.distance);
            surface.emission *= basic_radiance(*scene_, surface.before);
        }
        if (!is_black(surface.emission)) {
            const float mis =
                origin.pdf > 0 ? origin.weight_of_local(lights_->pdf_local(origin.receiver, hit.point)) : 1.0f;
            result.radiance += throughput * surface.emission * mis;
        }
        const bool last = bounce - straight >= settings_.max_bounces;
        if (last && !lets_straight_through(surface.bsdf)) return result;

        const ShadingBasis basis(surface.shading_normal);
        // Of light that is a small part of its pixel the noise is, too.
        const int light_samples = light_samples_at(settings_.light_samples, worth.importance < 1 ? bounce + 1 : bounce);
        const PreparedBsdf bsdf = prepare(surface.bsdf, basis.to_local(-ray.direction));
        if (!is_delta(bsdf))
            result.radiance += throughput * direct_light(*ray_scene_, *lights_, sky_guide_,
                                                         {*scene_, surface, bsdf, basis, sampler, u, bounce,
                                                          light_samples, relevance(throughput, worth)},
                                                         counters);

        const auto next = sample(bsdf, lobe.x, u.get_2d(Draw::bsdf));
        if (!next) return result;
        const Vec3 wi = basis.to_world(next->wi);
        // A direction above the shading normal's horizon may still enter the surface.
        if ((dot(wi, surface.geometric_normal) > 0) == next->transmitted) return result;
        throughput *= next->weight;
        if (is_black(throughput)) return result;
        if (bounce > 0) {
            const float share = worth.importance * max_component(throughput);
            const float survival = std::min(max_survival, share / settings_.path_roulette);
            if (u.get_1d(Draw::roulette) >= survival) return result;
            throughput *= 1 / survival;
        }
        // What light samples see through leaves them their part of what lies behind.
        if (next->transmitted && lets_straight_through(surface.bsdf))
            ++straight;
        else if (last)
            return result;
        else
            origin = {next->delta ? 0.0f : next->pdf, receiver_at(surface, bsdf), light_samples, true};
        if (next->transmitted && surface.volume >= 0) {
            if (surface.from_front)
                media.enter(surface.volume);
            else
                media.leave(surface.volume);
        }
        const Vec3 side = next->transmitted ? -surface.geometric_normal : surface.geometric_normal;
        ray = {offset_from_surface(surface.position, side, surface.extent), wi};
    }
}

}  // namespace pluvia
