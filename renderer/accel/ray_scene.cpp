#include "renderer/accel/ray_scene.h"

#include "renderer/accel/held_triangles.h"
#include "renderer/core/error.h"
#include "renderer/core/parallel.h"
#include "renderer/core/random.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <fmt/format.h>

#include <atomic>
#include <map>

namespace pluvia {
namespace {

// Copies of a small mesh are cheaper to trace as triangles of their own than through an instance.
constexpr size_t max_copied_triangles = 1 << 16;

struct GeometryTag {
    const Scene* scene;
    int instance;  // -1: the mesh is placed by Embree instances, which are numbered like Scene::instances
};

#if RTC_VERSION_MAJOR >= 4
struct QueryContext : RTCRayQueryContext {
#else
struct QueryContext : RTCIntersectContext {
#endif
    OpacityTest opacity;
    Counters* counters;
    const std::vector<int>* instance_of_geometry;
    bool passes_panes = false, met_pane = false;
};

int instance_of_hit(const std::vector<int>& instance_of_geometry, unsigned geometry, unsigned embree_instance) {
    return instance_of_geometry[embree_instance == RTC_INVALID_GEOMETRY_ID ? geometry : embree_instance];
}

const Material& material_of(const Scene& scene, int instance) {
    return scene.materials[scene.meshes[scene.instances[instance].mesh].material];
}

bool passes_by_opacity(const Scene& scene, const SurfacePoint& point, const OpacityTest& test, Counters& counters) {
    counters.count(Feature::alpha);
    const float alpha = opacity(scene, point);
    // alpha 0 always passes and alpha 1 never does, whatever the hash.
    return test.at_half ? alpha < 0.5f
                        : alpha <= unit_float(hash_key(test.key, uint64_t(point.instance), uint64_t(point.triangle)));
}

/// Called for every candidate hit on a mesh that may be transparent or a pane; rejects it where the ray passes.
void reject_transparent(const RTCFilterFunctionNArguments* args) {
    if (args->valid[0] == 0) return;
    auto& context = *static_cast<QueryContext*>(args->context);
    const auto& tag = *static_cast<const GeometryTag*>(args->geometryUserPtr);
    RTCHitN* hit = args->hit;
    const int instance =
        tag.instance >= 0 ? tag.instance : (*context.instance_of_geometry)[RTCHitN_instID(hit, args->N, 0, 0)];
    const SurfacePoint point{instance, int(RTCHitN_primID(hit, args->N, 0)), RTCHitN_u(hit, args->N, 0),
                             RTCHitN_v(hit, args->N, 0)};
    const Material& material = material_of(*tag.scene, instance);
    if (material.alpha_mode != AlphaMode::opaque &&
        passes_by_opacity(*tag.scene, point, context.opacity, *context.counters)) {
        args->valid[0] = 0;
    } else if (context.passes_panes && may_let_straight_through(material)) {
        context.met_pane = true;
        args->valid[0] = 0;
    }
}

std::vector<size_t> uses_of_meshes(const Scene& scene) {
    std::vector<size_t> uses(scene.meshes.size(), 0);
    for (const Instance& instance : scene.instances) ++uses[instance.mesh];
    return uses;
}

bool is_placed_by_instances(const Mesh& mesh, size_t uses) {
    return uses > 1 && uses * mesh.triangles.size() > max_copied_triangles;
}

RTCRay embree_ray(const Ray& ray) {
    RTCRay r = {};
    r.org_x = ray.origin.x, r.org_y = ray.origin.y, r.org_z = ray.origin.z;
    r.dir_x = ray.direction.x, r.dir_y = ray.direction.y, r.dir_z = ray.direction.z;
    r.tnear = 0, r.tfar = ray.t_max;
    r.mask = ~0u;
    return r;
}

QueryContext make_context(OpacityTest opacity, Counters& counters, const std::vector<int>& instance_of_geometry) {
    QueryContext context;
#if RTC_VERSION_MAJOR >= 4
    rtcInitRayQueryContext(&context);
#else
    rtcInitIntersectContext(&context);
#endif
    context.opacity = opacity;
    context.counters = &counters;
    context.instance_of_geometry = &instance_of_geometry;
    return context;
}

}  // namespace

struct RayScene::Embree {
    RTCDevice device = nullptr;
    RTCScene top = nullptr;
    std::vector<RTCScene> mesh_scenes;      // of meshes placed by instances, null for the others
    std::vector<int> instance_of_geometry;  // Scene instance of each geometry of `top`
    std::vector<std::unique_ptr<GeometryTag>> tags;

    ~Embree() {
        for (RTCScene s : mesh_scenes)
            if (s) rtcReleaseScene(s);
        if (top) rtcReleaseScene(top);
        if (device) rtcReleaseDevice(device);
    }

    void check_error() const {
        const RTCError error = rtcGetDeviceError(device);
        if (error != RTC_ERROR_NONE)
            throw Error(ExitCode::render_failed, "Embree",
                        error == RTC_ERROR_OUT_OF_MEMORY ? "has no memory left for the scene"
                                                         : fmt::format("failed with error {}", int(error)));
    }

    /// Triangles of a mesh as a geometry of `parent`; instance -1 keeps them in object space.
    void add_mesh(RTCScene parent, const Scene& scene, const Mesh& mesh, int instance, const Transform& transform,
                  GeometryTag* tag) {
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.positions.size()));
        auto* indices = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(uint32_t), mesh.triangles.size()));
        check_error();
        for (size_t i = 0; i < mesh.positions.size(); ++i) {
            const Vec3 p = Vec3(transform.point(Vec3d(mesh.positions[i])));
            vertices[3 * i] = p.x, vertices[3 * i + 1] = p.y, vertices[3 * i + 2] = p.z;
        }
        for (size_t i = 0; i < mesh.triangles.size(); ++i)
            for (int k = 0; k < 3; ++k) indices[3 * i + k] = mesh.triangles[i][k];
        *tag = {&scene, instance};
        rtcSetGeometryUserData(geometry, tag);
        if (may_be_transparent(scene, mesh)) {
            rtcSetGeometryIntersectFilterFunction(geometry, reject_transparent);
        }
        if (may_be_transparent(scene, mesh) || may_let_straight_through(scene.materials[mesh.material]))
            rtcSetGeometryOccludedFilterFunction(geometry, reject_transparent);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(parent, geometry);
        rtcReleaseGeometry(geometry);
    }

    bool is_occluded(const Ray& ray, QueryContext& context) const {
        ++context.counters->rays;
        RTCRay query = embree_ray(ray);
#if RTC_VERSION_MAJOR >= 4
        RTCOccludedArguments arguments;
        rtcInitOccludedArguments(&arguments);
        arguments.context = &context;
        rtcOccluded1(top, &query, &arguments);
#else
        rtcOccluded1(top, &context, &query);
#endif
        return query.tfar < 0;
    }

    /// Watertight, and built by one thread: how Embree splits a build among threads decides which of two coinciding
    /// triangles a ray meets, and pictures must not depend on the number of threads.
    RTCScene new_scene() const {
        RTCScene scene = rtcNewScene(device);
        rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
        return scene;
    }
};

size_t held_triangles(const Scene& scene) {
    const auto uses = uses_of_meshes(scene);
    size_t sum = 0;
    for (size_t i = 0; i < uses.size(); ++i) {
        const Mesh& mesh = scene.meshes[i];
        if (uses[i] > 0) sum += mesh.triangles.size() * (is_placed_by_instances(mesh, uses[i]) ? 1 : uses[i]);
    }
    return sum;
}

RayScene::RayScene(const Scene& scene) : scene_(&scene), embree_(std::make_unique<Embree>()) {
    Embree& e = *embree_;
    e.device = rtcNewDevice("hugepages=1");
    if (!e.device) throw Error(ExitCode::render_failed, "Embree", "cannot start");

    const auto uses = uses_of_meshes(scene);
    const auto is_instanced = [&](int mesh) { return is_placed_by_instances(scene.meshes[mesh], uses[mesh]); };

    // Every mesh in a hierarchy of its own is built by one thread; many of them at the same time.
    e.mesh_scenes.assign(scene.meshes.size(), nullptr);
    std::vector<int> instanced;
    for (size_t i = 0; i < scene.meshes.size(); ++i)
        if (is_instanced(int(i))) instanced.push_back(int(i));
    e.tags.resize(instanced.size() + scene.instances.size());
    for (auto& tag : e.tags) tag = std::make_unique<GeometryTag>();
    parallel_for(int(instanced.size()), [&](int k) {
        const int mesh = instanced[k];
        e.mesh_scenes[mesh] = e.new_scene();
        e.add_mesh(e.mesh_scenes[mesh], scene, scene.meshes[mesh], -1, Transform(), e.tags[k].get());
        run_serially([&] { rtcCommitScene(e.mesh_scenes[mesh]); });
    });

    e.top = e.new_scene();
    for (size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        if (scene.meshes[instance.mesh].triangles.empty()) continue;
        e.instance_of_geometry.push_back(int(i));
        const Transform& t = instance.scene_from_object;
        if (!is_instanced(instance.mesh)) {
            e.add_mesh(e.top, scene, scene.meshes[instance.mesh], int(i), t, e.tags[instanced.size() + i].get());
            continue;
        }
        RTCGeometry geometry = rtcNewGeometry(e.device, RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(geometry, e.mesh_scenes[instance.mesh]);
        float matrix[12];
        const Vec3d columns[4] = {t.column_x, t.column_y, t.column_z, t.translation};
        for (int c = 0; c < 4; ++c)
            for (int r = 0; r < 3; ++r) matrix[3 * c + r] = float(columns[c][r]);
        rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, matrix);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(e.top, geometry);
        rtcReleaseGeometry(geometry);
    }
    run_serially([&] { rtcCommitScene(e.top); });
    e.check_error();
}

RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;

bool RayScene::closest_hit(const Ray& ray, OpacityTest opacity, RayHit& hit, Counters& counters) const {
    ++counters.rays;
    QueryContext context = make_context(opacity, counters, embree_->instance_of_geometry);
    RTCRayHit query;
    query.ray = embree_ray(ray);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.context = &context;
    rtcIntersect1(embree_->top, &query, &arguments);
#else
    rtcIntersect1(embree_->top, &context, &query);
#endif
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
    hit.distance = query.ray.tfar;
    hit.point = {instance_of_hit(embree_->instance_of_geometry, query.hit.geomID, query.hit.instID[0]),
                 int(query.hit.primID), query.hit.u, query.hit.v};
    return true;
}

bool RayScene::occluded(const Ray& ray, OpacityTest opacity, Counters& counters) const {
    QueryContext context = make_context(opacity, counters, embree_->instance_of_geometry);
    return embree_->is_occluded(ray, context);
}

Obstruction RayScene::obstruction(const Ray& ray, OpacityTest opacity, Counters& counters) const {
    QueryContext context = make_context(opacity, counters, embree_->instance_of_geometry);
    context.passes_panes = true;
    if (embree_->is_occluded(ray, context)) return Obstruction::full;
    return context.met_pane ? Obstruction::panes : Obstruction::none;
}

}  // namespace pluvia
