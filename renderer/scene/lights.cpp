#include "renderer/scene/lights.h"

#include "renderer/core/sampling.h"
#include "renderer/scene/texture.h"

#include <array>
#include <limits>

namespace pluvia {
namespace {

constexpr double outshone_by_lamps = 10;  // horizontal illuminance in lux

/// Of an emissive triangle, over a few fixed points. No component is zero where the texture might shine: a light that
/// is never chosen would be missing from the picture.
Rgb mean_emission(const Scene& scene, int instance, int triangle) {
    const Material& material = scene.materials[scene.meshes[scene.instances[instance].mesh].material];
    if (!material.emission_texture.used()) return material.emission;
    constexpr int n = 4;
    Rgb sum;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const Vec2 b = sample_triangle({(i + 0.5f) / n, (j + 0.5f) / n});
            sum += emission(scene, {instance, triangle, b.x, b.y});
        }
    const Rgb mean = sum / float(n * n), least = material.emission * 1e-3f;
    return {std::max(mean.r, least.r), std::max(mean.g, least.g), std::max(mean.b, least.b)};
}

/// Falloff between the cones of a spot light; KHR_lights_punctual, "Inner and Outer Cone Angles".
float spot_falloff(const PunctualLight& light, Vec3 from_light) {
    const float cos_outer = std::cos(light.outer_cone_angle), cos_inner = std::cos(light.inner_cone_angle);
    const float t = (dot(from_light, light.direction) - cos_outer) / std::max(0.001f, cos_inner - cos_outer);
    return std::clamp(t, 0.0f, 1.0f) * std::clamp(t, 0.0f, 1.0f);
}

}  // namespace

Lights::Lights(const Scene& scene, const Environment& environment)
    : scene_(&scene), environment_(&environment), first_light_of_instance_(scene.instances.size(), -1) {
    std::vector<LightBounds> all;
    for (const PunctualLight& light : scene.lights) add_punctual(light, all);
    for (size_t i = 0; i < scene.instances.size(); ++i)
        if (scene.materials[scene.meshes[scene.instances[i].mesh].material].emits()) add_triangles(int(i), all);
    tree_ = LightTree(all);
    lamps_outshine_sky_ = has_local() && environment.sky_illuminance() < outshone_by_lamps;

    std::vector<float> lux;
    for (const PunctualLight& light : directional_) lux.push_back(luminance(light.intensity));
    if (!directional_.empty()) directional_choice_ = Distribution1D(lux);
    const double sky = environment.is_black() ? 0 : pi * luminance(environment.mean_radiance());
    const double beams = directional_.empty() ? 0 : directional_choice_.total();
    if (directional_.empty()) return;
    environment_share_ = sky > 0 ? std::clamp(float(sky / (sky + beams)), 0.1f, 0.9f) : 0.0f;
    const double discs = environment.disc_illuminance();
    disc_share_ = environment.has_sun() ? std::clamp(float(discs / (discs + beams)), 0.1f, 0.9f) : 0.0f;
}

void Lights::add_punctual(const PunctualLight& light, std::vector<LightBounds>& all) {
    if (is_black(light.intensity)) return;
    if (light.kind == PunctualLight::Kind::directional) {
        directional_.push_back(light);
        return;
    }
    LightBounds b;
    b.lower = b.upper = Vec3(light.position);
    b.power = 4 * pi * luminance(light.intensity);
    if (light.kind == PunctualLight::Kind::spot) {
        b.axis = light.direction;
        b.cos_spread = 1;
        b.cos_emission = std::cos(light.outer_cone_angle);
    }
    punctual_.push_back(light);
    all.push_back(b);
}

void Lights::add_triangles(int instance, std::vector<LightBounds>& all) {
    first_light_of_instance_[instance] = int(triangles_.size());
    const Mesh& mesh = scene_->meshes[scene_->instances[instance].mesh];
    const bool two_sided = scene_->materials[mesh.material].double_sided;
    for (int k = 0; k < int(mesh.triangles.size()); ++k) {
        const auto corner = corners(*scene_, instance, k);
        const Vec3d normal = front_normal(*scene_, instance, k);
        const double area = 0.5 * length(normal);
        const Rgb mean = mean_emission(*scene_, instance, k);
        LightBounds b;
        b.lower = Vec3(min(corner[0], min(corner[1], corner[2])));
        b.upper = Vec3(max(corner[0], max(corner[1], corner[2])));
        if (area > 0) {
            b.axis = Vec3(normalize(normal));
            b.cos_spread = 1;
            b.two_sided = two_sided;
            b.power = (two_sided ? 2 : 1) * pi * float(area) * luminance(mean);
        }
        triangles_.push_back({instance, k, Vec3(corner[0]), Vec3(corner[1] - corner[0]), Vec3(corner[2] - corner[0]),
                              Vec3(normal), mean, two_sided});
        all.push_back(b);
    }
}

std::optional<Lights::LocalPoint> Lights::choose_local(const Receiver& receiver, float u_choice, Vec2 u) const {
    const auto choice = tree_.choose(receiver, u_choice);
    if (!choice) return std::nullopt;
    return LocalPoint{choice->light, u, choice->probability};
}

void Lights::choose_local(const Receiver& receiver, float u_choice, std::span<LocalPoint> points) const {
    std::array<LightTree::Choice, LightTree::max_choices> choices;
    const size_t count = std::min(points.size(), choices.size());
    tree_.choose(receiver, u_choice, {choices.data(), count});
    for (size_t i = 0; i < count; ++i) points[i] = {choices[i].light, Vec2(), choices[i].probability};
}

Vec3 Lights::position(const LocalPoint& point) const {
    const int punctual_count = int(punctual_.size());
    if (point.light < punctual_count) return Vec3(punctual_[point.light].position);
    const Vec2 b = sample_triangle(point.u);
    return triangles_[point.light - punctual_count].point(b.x, b.y);
}

LightSample Lights::illuminate(Vec3 place, const LocalPoint& point) const {
    if (point.light < int(punctual_.size())) return punctual_light(place, punctual_[point.light], point.probability);
    return triangle_light(place, point, [&](const EmissiveTriangle& triangle, Vec2 b) {
        const SurfacePoint on_it{triangle.instance, triangle.triangle, b.x, b.y};
        return emission(*scene_, on_it) * opacity(*scene_, on_it);
    });
}

LightSample Lights::estimate(Vec3 place, const LocalPoint& point) const {
    if (point.light < int(punctual_.size())) return punctual_light(place, punctual_[point.light], point.probability);
    return triangle_light(place, point, [](const EmissiveTriangle& triangle, Vec2) { return triangle.mean_emission; });
}

LightSample Lights::punctual_light(Vec3 place, const PunctualLight& light, float probability) const {
    const Vec3 to_light = Vec3(light.position - Vec3d(place));
    const float distance_squared = length_squared(to_light);
    if (distance_squared == 0) return {Vec3(0, 1, 0), 0, Rgb(0), 1, true};
    const float distance = std::sqrt(distance_squared);
    const Vec3 wi = to_light / distance;
    const float falloff = light.kind == PunctualLight::Kind::spot ? spot_falloff(light, -wi) : 1.0f;
    return {wi, distance, light.intensity * (falloff / distance_squared), probability, true};
}

/// emission: radiance of a triangle at a point with barycentric coordinates.
template <class Emission>
LightSample Lights::triangle_light(Vec3 place, const LocalPoint& point, const Emission& emission) const {
    const EmissiveTriangle& triangle = triangles_[point.light - int(punctual_.size())];
    const Vec2 b = sample_triangle(point.u);
    const Vec3 to_light = triangle.point(b.x, b.y) - place;
    const float distance_squared = length_squared(to_light), distance = std::sqrt(distance_squared);
    const Vec3 wi = to_light / distance;
    const float cosine = dot(triangle.front, wi);
    // dA to solid angle; |front| is twice the area, so the cosine and the area are both in this product.
    const float projected_area = 0.5f * std::abs(cosine);
    const bool dark_side = cosine > 0 && !triangle.two_sided;
    if (dark_side || projected_area == 0 || distance_squared == 0) return {wi, distance, Rgb(0), 1, false};
    return {wi, distance, emission(triangle, b), point.probability * distance_squared / projected_area, false};
}

float Lights::pdf_local(const Receiver& receiver, const SurfacePoint& point) const {
    const int first = first_light_of_instance_[point.instance];
    if (first < 0) return 0;
    const EmissiveTriangle& triangle = triangles_[first + point.triangle];
    const Vec3 to_light = triangle.point(point.b1, point.b2) - receiver.position;
    const float distance_squared = length_squared(to_light);
    const float projected_area = 0.5f * std::abs(dot(triangle.front, to_light / std::sqrt(distance_squared)));
    const float probability = tree_.probability(receiver, int(punctual_.size()) + first + point.triangle);
    return projected_area > 0 ? probability * distance_squared / projected_area : 0;
}

std::optional<LightSample> Lights::sample_distant(float u_choice, Vec2 u) const {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    if (u_choice < environment_share_) {
        const EnvironmentSample s = environment_->sample(u, u_choice / environment_share_);
        if (!(s.pdf > 0)) return std::nullopt;
        return LightSample{s.wi, infinity, s.radiance, s.pdf * environment_share_, false};
    }
    return directional_light((u_choice - environment_share_) / (1 - environment_share_), 1 - environment_share_);
}

LightSample Lights::directional_light(float u_choice, float probability) const {
    const auto choice = directional_choice_.sample(u_choice);
    const PunctualLight& light = directional_[choice.cell];
    return {-light.direction, std::numeric_limits<float>::infinity(), light.intensity,
            directional_choice_.probability(choice.cell) * probability, true};
}

LightSample Lights::sample_sun(float u_choice, Vec2 u) const {
    if (u_choice >= disc_share_)
        return directional_light((u_choice - disc_share_) / (1 - disc_share_), 1 - disc_share_);
    const EnvironmentSample s = environment_->sample_sun(u, u_choice / disc_share_);
    return {s.wi, std::numeric_limits<float>::infinity(), s.radiance, s.pdf * disc_share_, false};
}

}  // namespace pluvia
