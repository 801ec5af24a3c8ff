#include "renderer/transport/label_layers.h"

#include "renderer/scene/surface_bsdf.h"
#include "renderer/scene/taxonomy.h"
#include "renderer/scene/triangle.h"

#include <limits>

namespace pluvia {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

// Seen in the other frame is what lies no deeper than this behind the first surface there, relative to the distance:
// corners of triangles are known to single precision, and a ray that grazes its own surface meets the neighbours.
constexpr double hidden_tolerance = 1e-4, hidden_tolerance_metres = 2e-3;

Vec3d place(const Scene& scene, const SurfacePoint& point) {
    const auto corner = corners(scene, point.instance, point.triangle);
    return corner[0] * (1.0 - point.b1 - point.b2) + corner[1] * point.b1 + corner[2] * point.b2;
}

struct Projected {
    double x, y;
};
/// Of view coordinates in front of the camera.
Projected project(const View& view, Vec3d v) {
    const double s = view.focal_pixels / v.z;
    return {view.width / 2.0 + v.x * s, view.height / 2.0 - v.y * s};
}

void put(float*& values, Vec3 v) {
    for (const float c : {v.x, v.y, v.z}) *values++ = c;
}

}  // namespace

std::vector<std::string> label_channels(const LabelLayers& layers) {
    std::vector<std::string> names;
    const auto add = [&](bool wanted, const std::string& layer, std::initializer_list<const char*> channels) {
        for (const char* channel : channels)
            if (wanted) names.push_back(layer + channel);
    };
    add(layers.normals, "N", {".X", ".Y", ".Z"});
    add(layers.albedo, "albedo", {".R", ".G", ".B"});
    add(layers.position, "position", {".X", ".Y", ".Z"});
    for (const char* flow : {"flow_fwd", "flow_bwd"}) add(layers.flow, flow, {".U", ".V", ".occlusion"});
    return names;
}

std::vector<std::string> label_id_channels(const LabelLayers& layers) {
    std::vector<std::string> names;
    if (layers.semantic) names.push_back("semantic.ID");
    if (layers.instance) names.push_back("instance.ID");
    return names;
}

struct LabelTracer::Other {
    const Scene& scene;
    const View& view;
    std::optional<RayScene> own;
    const RayScene& ray_scene;

    Other(const Scene& frame_scene, const RayScene& frame_ray_scene, const OtherFrame& other)
        : scene(other.scene ? *other.scene : frame_scene),
          view(other.view),
          own(other.scene ? std::make_optional<RayScene>(*other.scene) : std::nullopt),
          ray_scene(own ? *own : frame_ray_scene) {}
};

LabelTracer::LabelTracer(const Scene& scene, const RayScene& ray_scene, const View& view, const LabelSettings& settings)
    : scene_(scene), view_(view), settings_(settings) {
    if (!settings.layers.flow) return;
    for (const auto* other : {&settings.next, &settings.previous})
        others_.push_back(std::make_unique<Other>(scene, ray_scene, other->value()));
}

LabelTracer::~LabelTracer() = default;

void LabelTracer::write(Vec3 direction, const RayHit* hit, float* values, uint32_t* ids, Counters& counters) const {
    counters.count(Feature::label);
    const LabelLayers& layers = settings_.layers;
    const LabelObject* object = nullptr;
    if (hit && settings_.objects)
        object =
            &settings_.objects->objects[size_t(settings_.objects->object_of_instance[size_t(hit->point.instance)])];
    if (layers.semantic) *ids++ = uint32_t(hit ? object->class_id : sky_id);
    if (layers.instance) *ids++ = hit ? object->id : 0;
    if (layers.normals)
        put(values, hit ? evaluate_surface(scene_, hit->point, direction, 0, counters).shading_normal : Vec3());
    if (layers.albedo) {
        Rgb color(0);
        if (hit) {
            const Triangle triangle(scene_, hit->point);
            color = base_color(scene_, scene_.materials[size_t(triangle.mesh.material)], triangle, counters);
        }
        put(values, {color.r, color.g, color.b});
    }
    const Vec3d world = hit ? place(scene_, hit->point) : Vec3d();
    if (layers.position) put(values, hit ? Vec3(world + scene_.origin) : Vec3(infinity, infinity, infinity));
    for (const auto& other : others_) {
        write_flow(*other, world, direction, hit, values, counters);
        values += 3;
    }
}

void LabelTracer::write_flow(const Other& other, Vec3d world, Vec3 direction, const RayHit* hit, float* values,
                             Counters& counters) const {
    // The sky is so far away that only the camera's turning moves it.
    const auto seen_by = [&](const View& view, Vec3d point) {
        return hit ? view.view_from_world(point) : view.view_from_world(view.position + Vec3d(direction));
    };
    const Vec3d there = hit && &other.scene != &scene_ ? place(other.scene, hit->point) : world;
    const Vec3d before = seen_by(view_, world), after = seen_by(other.view, there);
    values[0] = values[1] = 0;
    if (!(after.z > 1e-6)) {
        values[2] = float(FlowVisibility::behind);
        return;
    }
    const Projected from = project(view_, before), to = project(other.view, after);
    values[0] = float(to.x - from.x), values[1] = float(to.y - from.y);
    FlowVisibility visibility = FlowVisibility::visible;
    if (to.x < 0 || to.y < 0 || to.x >= other.view.width || to.y >= other.view.height) {
        visibility = FlowVisibility::outside;
    } else {
        Ray ray{Vec3(other.view.position), direction};
        double limit = std::numeric_limits<double>::infinity();
        if (hit) {
            const Vec3d way = there - other.view.position;
            ray.direction = Vec3(normalize(way));
            limit = length(way) * (1 - hidden_tolerance) - hidden_tolerance_metres;
        }
        RayHit first;
        if (other.ray_scene.closest_hit(ray, {.at_half = true}, first, counters) && first.distance < limit)
            visibility = FlowVisibility::hidden;
    }
    values[2] = float(visibility);
}

}  // namespace pluvia
