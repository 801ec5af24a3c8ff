// A small street whose labels are known, and a frame of it as `pluvia render --layers all` writes it.
#pragma once

#include "renderer/scene/gltf.h"
#include "tests/run_program.h"
#include "tests/test_scenes.h"
#include "tools/labels/label_frame.h"

#include <doctest/doctest.h>

namespace pluvia {

/// A road, a wall with a window through which more is seen, two cars, a person, a pole and a group of poles, under the
/// sky; a camera that drives.
inline Scene labelled_street() {
    Scene scene;
    scene.name = "street";
    const auto named = [&](int index, const std::string& name, const std::string& semantic) {
        Instance& instance = scene.instances[size_t(index)];
        instance.name = name, instance.id = instance_id(name), instance.semantic = semantic;
    };
    const auto grey = [](float v) { return lambert(Rgb(v)); };
    const auto box = [&](Vec3 lower, Vec3 upper) { return add_box(scene, lower, upper, grey(0.5f)); };
    named(add_quad(scene, {-40, 0, 20}, {80, 0, 0}, {0, 0, -80}, grey(0.2f)), "ground/road", "road");
    named(box({-2.2f, 0, -12}, {-0.4f, 1.4f, -8}), "traffic/car_1", "car");
    named(box({2.0f, 0, -11}, {3.8f, 1.4f, -7}), "traffic/car_2", "car");
    named(box({0.6f, 0, -6.3f}, {1.0f, 1.7f, -6.0f}), "people/person_1", "person");
    named(box({-1.65f, 0, -5.55f}, {-1.5f, 4, -5.4f}), "poles/pole_1", "pole");
    named(box({1.45f, 0, -5.55f}, {1.6f, 4, -5.4f}), "poles/group_1", "polegroup");
    // Four parts around an opening, one object: no convex hull is its outline.
    named(box({-6, 0, -14}, {6, 1.6f, -13.8f}), "houses/wall_1", "building");
    named(box({-6, 3.2f, -14}, {6, 4.2f, -13.8f}), "houses/wall_1", "building");
    named(box({-6, 1.6f, -14}, {-1, 3.2f, -13.8f}), "houses/wall_1", "building");
    named(box({1.5f, 1.6f, -14}, {6, 3.2f, -13.8f}), "houses/wall_1", "building");
    Camera camera{"drive", translate({0, 1.5, 0}), 0.5, {}};
    camera.path = {{0, {0, 1.5, 0}}, {2, {0.4, 1.5, -4}}};
    scene.cameras.push_back(camera);
    return scene;
}

/// Renders frame `number` of a scene with all labels into folder/name.
inline LabelSource render_labels(const TemporaryFolder& folder, const Scene& scene, const std::string& name,
                                 int number = 0, const std::string& more = "",
                                 const std::vector<NodeMotion>& motions = {}) {
    const std::string file = folder / (name + ".glb");
    save_glb(scene, file, motions);
    const Outcome outcome =
        run_program("render " + file + " -o " + (folder / name) + " --frame " + std::to_string(number) +
                    " --fps 10 --size 192x96 --spp 1 --bounces 0 --environment 100,100,100 --layers all"
                    " --progress none " +
                    more);
    REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
    return label_source(folder / name);
}

}  // namespace pluvia
