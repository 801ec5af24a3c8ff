// Assembly: how a builder turns shapes into the materials, meshes and instances of a Scene.
// A street is built as assemblies (shapes sorted by finish), each becoming one object of the scene or a prop placed
// often.
#pragma once

#include "renderer/core/random.h"
#include "renderer/scene/scene.h"
#include "scenes/shapes.h"
#include "scenes/surfaces.h"

#include <map>
#include <string>
#include <vector>

namespace pluvia {

/// A material together with the metres that its pictures cover; shapes are sorted by the index of their finish.
struct Finish {
    int material = -1;
    Vec2 picture_size = {1, 1};
};

/// Shapes by finish, in the object's own frame.
struct Assembly {
    std::map<int, Shape> shapes;
    Shape& operator[](int finish) { return shapes[finish]; }
};

/// A scene being built.
struct Street {
    Scene scene;
    std::vector<Finish> finishes;
};

/// Indices of textures in a scene, one per slot.
struct MapTextures {
    int base_color = -1, metallic_roughness = -1, normal = -1;
};
int add_texture(Scene& scene, Image<Rgba8> image, Wrap wrap = Wrap::repeat);
MapTextures add_textures(Scene& scene, SurfaceMaps maps, Wrap wrap = Wrap::repeat);

/// Adds a finish whose material has these textures where it has none yet; returns its index.
int add_finish(Street& street, Material material, const MapTextures& textures = {}, Vec2 picture_size = {1, 1});

/// Adds the meshes of an assembly, one per finish; the result is what place() takes, any number of times.
std::vector<int> add_meshes(Street& street, const std::string& name, const Assembly& assembly);

/// Instances of all meshes under one path, so that they share one instance id. semantic: class as Cityscapes has it.
void place(Street& street, const std::string& path, const std::string& semantic, const std::vector<int>& meshes,
           const Transform& scene_from_object);

/// add_meshes and place for an object that exists once.
void place_once(Street& street, const std::string& path, const std::string& semantic, const Assembly& assembly,
                const Transform& scene_from_object = {});

/// Copies all shapes of `part`; the transform may rotate, move, scale and mirror.
void append(Assembly& assembly, const Assembly& part, const Transform& assembly_from_part);

/// A camera at `position` that looks at `target` through a lens of this focal length in mm on a picture of 36 x 18 mm
/// and moves by `travel` metres in `seconds`.
Camera look_at(const std::string& name, Vec3d position, Vec3d target, double focal_length_mm, Vec3d travel = {},
               float seconds = 0);

/// Turn around the vertical axis, counter-clockwise as seen from above.
Transform rotate_y(double radians);

/// Repeatable chance: a number that depends only on what it is for.
struct Chance {
    uint64_t key = 0;

    /// Uniform in [lower, upper), the next one of this key.
    float operator()(float lower, float upper) {
        key = mix_bits(key + 0x9e3779b97f4a7c15ull);
        return lower + (upper - lower) * unit_float(key);
    }
    /// Grey tint around 1 and a place in the texture, so that no two boards look alike.
    Tint tint(float spread) {
        const float grey = (*this)(1 - spread, 1), warmth = (*this)(-0.25f, 0.25f) * spread;
        const float u = (*this)(0, 8), v = (*this)(0, 8);
        return {Rgb(grey * (1 + warmth), grey, grey * (1 - warmth)), {u, v}};
    }
};

}  // namespace pluvia
