// Scene: the one description of a street that builders make, glTF files hold and paths are traced through.
// A plain struct of vectors whose parts refer to each other by index; it does not change while tracing.
// Axes as in glTF: +Y up, metres. gltf.h reads and writes it, surface.h evaluates it at a hit; materials
// are in material.h.
#pragma once

#include "renderer/core/rgb.h"
#include "renderer/core/transform.h"
#include "renderer/core/units.h"
#include "renderer/image/image.h"
#include "renderer/scene/material.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace pluvia {

struct Tangent {
    Vec3 direction;
    float sign = 1;  // bitangent = sign * cross(normal, direction)
};

/// Triangles with one material. All attributes but positions may be empty; otherwise one value per vertex.
struct Mesh {
    std::string name;
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;  // unit length
    std::vector<Vec2> uvs;      // (0, 0) is the upper left corner of the picture
    std::vector<Vec2> uvs1;     // a second set that texture slots may choose
    std::vector<Tangent> tangents;
    std::vector<Rgb> colors;    // linear, multiply the base colour
    std::vector<float> alphas;  // multiply alpha; empty or as long as colors
    std::vector<std::array<uint32_t, 3>> triangles;
    int material = -1;  // index into Scene::materials
};

/// A mesh placed in the scene.
struct Instance {
    std::string name;  // path of the node, e.g. "street/lamp_3"
    uint32_t id = 0;   // hash of the path, stable across frames
    int mesh = -1;
    Transform scene_from_object;
    bool lamp = false;          // what it emits can be switched: see lamps.h
    std::string semantic = {};  // name of its class as Cityscapes has it, e.g. "traffic sign"; empty = none given
};

struct PunctualLight {
    enum class Kind { point, spot, directional };
    std::string name = {};
    Kind kind = Kind::point;
    Rgb intensity = Rgb(1);  // candela for point and spot, lux for directional
    Vec3d position = {};
    Vec3 direction = {0, 0, -1};                            // in which the light shines; spot and directional
    float inner_cone_angle = 0, outer_cone_angle = pi / 4;  // radians from the axis
    bool lamp = false;                                      // it can be switched: see lamps.h
};

/// Where a camera is at a time in seconds.
struct CameraKey {
    float time = 0;
    Vec3d position;
};

struct Camera {
    std::string name;
    Transform scene_from_camera;  // looks along -z, +y up; scale is ignored
    double vertical_fov = 0.6;    // radians, holds whatever the picture's shape
    /// Straight from key to key, which a file holds as an animation. A scene that was read is that of one moment: its
    /// cameras have none.
    std::vector<CameraKey> path = {};
    // During the exposure at whose middle the scene was read:
    Vec3d velocity = {};          // m/s
    Vec3d angular_velocity = {};  // rad/s, about this axis
};

struct Scene {
    std::string name;
    Vec3d origin;  // the scene's coordinates are the file's minus this, so that float32 is fine near the street
    std::vector<Image<Rgba8>> images;
    std::vector<Texture> textures;
    std::vector<Material> materials;
    std::vector<Mesh> meshes;
    std::vector<Instance> instances;
    std::vector<PunctualLight> lights;
    std::vector<Camera> cameras;
    float unlit_luminance = 100;        // cd/m2 of white unlit surfaces, which are meant to be shown as they are
    std::vector<std::string> warnings;  // what the file asks for and is rendered without, by name
};

/// Hash of a node's path that is its id in label pictures (32 bits, never 0).
uint32_t instance_id(const std::string& path);

struct Bounds {
    Vec3d lower = {1e300, 1e300, 1e300}, upper = {-1e300, -1e300, -1e300};

    bool empty() const { return lower.x > upper.x; }
    void add(Vec3d p) { lower = min(lower, p), upper = max(upper, p); }
};
/// Box around all instances, in the scene's coordinates.
Bounds bounds(const Scene& scene);

/// Moves the coordinates so that their zero is the centre of the scene: a street a million metres away loses nothing
/// to float32. Idempotent to rounding.
void rebase(Scene& scene);
/// The same for a centre of one's own.
void rebase(Scene& scene, Vec3d centre);

/// The same street seen by a camera that shows all of it, for files without one.
Camera framing_camera(const Scene& scene);

/// Hash of everything that a picture of the scene depends on, names excepted.
uint64_t content_hash(const Scene& scene);

/// Throws Error (input) when an index, a size or a value is out of range; where: the file or builder to blame.
void check(const Scene& scene, const std::string& where);

}  // namespace pluvia
