// Lamps by day: what is marked goes dark, the rest shines on, and a file carries the marks.
#include "renderer/scene/lamps.h"

#include "renderer/scene/gltf.h"
#include "tests/gltf_draft.h"
#include "tests/test_scenes.h"

#include <doctest/doctest.h>

namespace pluvia {
namespace {

/// Two quads that share a mesh, one of them a lamp; one with a lamp's material; one that always shines.
Scene lamps_and_sign() {
    Scene scene;
    add_quad(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, emitter(Rgb(100)));
    Instance lamp = scene.instances[0];
    lamp.name = "lamp", lamp.lamp = true;
    scene.instances.push_back(lamp);
    Material glass = emitter(Rgb(200));
    glass.lamp = true;
    add_quad(scene, {2, 0, 0}, {1, 0, 0}, {0, 1, 0}, glass);
    scene.lights = {{.name = "lantern", .lamp = true}, {.name = "moon"}};
    return scene;
}

Rgb emission_of(const Scene& scene, int instance) {
    return scene.materials[scene.meshes[scene.instances[instance].mesh].material].emission;
}

}  // namespace

TEST_CASE("lamps that are off give no light, and all else shines as before") {
    Scene scene = lamps_and_sign();
    CHECK(lamp_count(scene) == 3);
    switch_off_lamps(scene);
    check(scene, "test");
    CHECK(emission_of(scene, 0) == Rgb(100));
    CHECK(is_black(emission_of(scene, 1)));
    CHECK(is_black(emission_of(scene, 2)));
    REQUIRE(scene.lights.size() == 1);
    CHECK(scene.lights[0].name == "moon");
}

TEST_CASE("a file keeps which materials, nodes and lights are lamps") {
    const TemporaryFolder folder;
    Scene scene = lamps_and_sign();
    save_glb(scene, folder / "lamps.glb");
    const Scene read = load_gltf(folder / "lamps.glb");
    CHECK(lamp_count(read) == 3);
    REQUIRE(read.instances.size() == 3);
    for (const Instance& instance : read.instances) CHECK(instance.lamp == (instance.name == "lamp"));
    for (const PunctualLight& light : read.lights) CHECK(light.lamp == (light.name == "lantern"));
    scene.instances[1].lamp = false;
    save_glb(scene, folder / "fewer.glb");
    CHECK(content_hash(load_gltf(folder / "fewer.glb")) != content_hash(read));
}

TEST_CASE("a marked node makes lamps of all below it, and of nothing beside it") {
    GltfDraft draft = triangle_draft();
    const int leaf = draft.add("nodes", {{"name", "leaf"}, {"mesh", 0}});
    draft.add_root({{"name", "post"}, {"children", {leaf}}, {"extras", {{"pluvia", {{"lamp", true}}}}}});
    draft.add_root({{"name", "bench"}, {"mesh", 0}, {"extras", {{"pluvia", {{"lamp", false}}}}}});
    draft.add_root({{"name", "tree"}, {"mesh", 0}, {"extras", {{"pluvia", "lamp"}, {"lamp", true}}}});
    for (const Instance& instance : load(draft).instances) {
        CAPTURE(instance.name);
        CHECK(instance.lamp == (instance.name == "post/leaf"));
    }
}

}  // namespace pluvia
