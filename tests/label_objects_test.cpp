// What counts as one object, which class it has, and its boxes.
#include "renderer/scene/gltf.h"
#include "renderer/scene/object_extent.h"
#include "renderer/scene/taxonomy.h"
#include "tests/error_of.h"
#include "tests/gltf_draft.h"
#include "tests/test_scenes.h"
#include "tools/frame_objects.h"
#include "tools/label_rules.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace pluvia {
namespace {

/// A file with a car of two nodes, a forest of copies under a class, and a node without any.
GltfDraft street_draft() {
    GltfDraft draft;
    const int mesh = draft.add_triangle_mesh();
    const auto node = [&](Json json) { return draft.add("nodes", std::move(json)); };
    const int wheel = node({{"name", "wheel"}, {"mesh", mesh}});
    draft.add_root({{"name", "taxi"}, {"mesh", mesh}, {"children", {wheel}}, {"extras", {{"semantic", "car"}}}});
    const int at = draft.add_floats({0, 0, 0, 5, 0, 0, 9, 0, 0}, "VEC3");
    const Json copies = {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", at}}}}}};
    const int trees = node({{"name", "trees"}, {"mesh", mesh}, {"extensions", copies}});
    draft.add_root({{"name", "park"}, {"children", {trees}}, {"extras", {{"semantic", "vegetation"}}}});
    draft.add_root({{"name", "thing"}, {"mesh", mesh}});
    draft.add_root({{"name", "duck"}, {"mesh", mesh}, {"extras", {{"semantic", "waterfowl"}}}});
    return draft;
}

struct Loaded {
    Scene scene;
    SceneObjects objects;
};
Loaded loaded(const GltfDraft& draft, const std::vector<LabelRule>& rules = {}, double time = 0) {
    const TemporaryFolder folder;
    GltfContents contents;
    Loaded result{load_gltf(write(folder, "street.gltf", draft.gltf()), {.time = time}, &contents), {}};
    result.objects = label_objects(result.scene, contents.labelled_paths, rules);
    return result;
}

const LabelObject& object_of(const Loaded& l, const std::string& instance) {
    for (size_t i = 0; i < l.scene.instances.size(); ++i)
        if (l.scene.instances[i].name == instance) return l.objects.objects[size_t(l.objects.object_of_instance[i])];
    FAIL("there is no instance " << instance);
    return l.objects.objects[0];
}

std::vector<LabelRule> rules_of(const std::string& yaml) {
    const TemporaryFolder folder;
    return read_label_rules(write(folder, "labels.yaml", yaml));
}

}  // namespace

TEST_CASE("a node with a class is one object with all below it, copies are objects of their own") {
    const Loaded l = loaded(street_draft());
    CHECK(&object_of(l, "taxi") == &object_of(l, "taxi/wheel"));
    CHECK(object_of(l, "taxi/wheel").name == "taxi");
    CHECK(object_of(l, "taxi").id == instance_id("taxi"));
    CHECK(object_of(l, "taxi").class_id == class_id("car"));
    std::set<uint32_t> trees;
    for (int i = 0; i < 3; ++i) {
        const LabelObject& tree = object_of(l, "park/trees[" + std::to_string(i) + "]");
        CHECK(tree.class_id == class_id("vegetation"));
        CHECK(tree.number == i);
        trees.insert(tree.id);
    }
    CHECK(trees.size() == 3);
    CHECK(object_of(l, "thing").class_id == unlabeled_id);
    CHECK(object_of(l, "duck").class_id == unlabeled_id);
    CHECK(object_of(l, "duck").unknown_class == "waterfowl");
}

TEST_CASE("rules give classes by names, join nodes to objects, and come before the file") {
    const auto rules = rules_of(
        "- nodes: \"(t.*)/.*|thing\"\n  class: Traffic_Sign\n"
        "- nodes: \"taxi|duck\"\n  class: train\n  object: rolling\n"
        "- nodes: park\n  class: terrain\n");
    const Loaded l = loaded(street_draft(), rules);
    CHECK(object_of(l, "thing").class_id == class_id("traffic sign"));
    CHECK(object_of(l, "taxi/wheel").class_id == class_id("traffic sign"));  // nearer than the rule for taxi
    CHECK(object_of(l, "taxi").class_id == class_id("train"));
    CHECK(&object_of(l, "taxi") == &object_of(l, "duck"));
    CHECK(object_of(l, "park/trees[1]").name == "park");
    CHECK(object_of(l, "park/trees[1]").class_id == class_id("terrain"));
    const auto named = rules_of("- {nodes: \"(ta|th)(.).*\", class: car, object: \"$1-$2\"}\n");
    CHECK(object_of(loaded(street_draft(), named), "taxi/wheel").name == "ta-x");
}

TEST_CASE("a file of rules that is wrong is refused with its line") {
    const auto refused = [](const std::string& yaml) { return std::string(error_of([&] { rules_of(yaml); }).what()); };
    CHECK(refused("- nodes: a\n  class: vegitation\n").find("did you mean vegetation?") != std::string::npos);
    CHECK(refused("- nodes: a\n  class: car\n  colour: red\n").find(":3: there is no key \"colour\"") !=
          std::string::npos);
    CHECK(refused("- nodes: \"(a\"\n  class: car\n").find("is no regular expression") != std::string::npos);
    CHECK(refused("- class: car\n  nodes: 'a{1111}'\n").find(":2: nodes is too long") != std::string::npos);
    CHECK(refused("- class: car\n").find("has no key \"nodes\"") != std::string::npos);
    CHECK(refused("- nodes: a\n").find("has no key \"class\"") != std::string::npos);
    CHECK(refused("nodes: a\n").find("expected a list") != std::string::npos);
}

TEST_CASE("ids are the same in every frame and whatever else the file holds") {
    GltfDraft draft = street_draft();
    const int times = draft.add_floats({0, 1}, "SCALAR"), places = draft.add_floats({0, 0, 0, 3, 0, 0}, "VEC3");
    draft.add("animations", {{"samplers", {{{"input", times}, {"output", places}}}},
                             {"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}}}});
    const Loaded before = loaded(draft, {}, 0), after = loaded(draft, {}, 1);
    REQUIRE(before.objects.objects.size() == after.objects.objects.size());
    for (size_t i = 0; i < before.objects.objects.size(); ++i) {
        CHECK(before.objects.objects[i].id == after.objects.objects[i].id);
        CHECK(before.objects.objects[i].number == after.objects.objects[i].number);
    }
    CHECK(before.scene.instances[0].scene_from_object.translation !=
          after.scene.instances[0].scene_from_object.translation);
    draft.add_root({{"name", "kiosk"}, {"mesh", 0}});
    const Loaded more = loaded(draft);
    for (const LabelObject& object : before.objects.objects)
        CHECK(std::any_of(more.objects.objects.begin(), more.objects.objects.end(),
                          [&](const LabelObject& o) { return o.id == object.id && o.name == object.name; }));
}

TEST_CASE("objects of a large scene have different ids, also where hashes collide") {
    // Of 200,000 names some five pairs share 32 bits: 200000^2 / 2 / 2^32.
    Scene scene = make_plane(lambert(Rgb(0.5f)));
    const Instance one = scene.instances[0];
    std::set<uint32_t> hashes;
    for (int i = 0; i < 200000; ++i) {
        scene.instances.push_back(one);
        scene.instances.back().name = "tree_" + std::to_string(i);
        hashes.insert(instance_id(scene.instances.back().name));
    }
    CHECK(hashes.size() < 200000);
    std::set<uint32_t> ids;
    for (const LabelObject& object : label_objects(scene, {}, {}).objects) ids.insert(object.id);
    CHECK(ids.size() == 200001);
    CHECK(!ids.contains(0));
}

TEST_CASE("the box of an object lies along it, and its projection hugs what is seen") {
    Scene scene;
    const int index = add_box(scene, {-1, 0, -2}, {1, 1.5f, 2}, lambert(Rgb(0.5f)));
    Instance& car = scene.instances[size_t(index)];
    const double angle = 0.5;
    car.scene_from_object = translate({1, 0, -12}) * rotate(0, std::sin(angle / 2), 0, std::cos(angle / 2));
    const SceneObjects objects = label_objects(scene, {}, {});
    const View view = look_at({0, 1.2f, 0}, {0, 1, -10}, 400, 200, 300);
    const ObjectExtent extent = object_extents(scene, objects, view)[0];
    CHECK(extent.box.size.x == doctest::Approx(2));
    CHECK(extent.box.size.y == doctest::Approx(1.5));
    CHECK(extent.box.size.z == doctest::Approx(4));
    CHECK(length(extent.box.centre - Vec3d(1, 0.75, -12)) < 1e-6);
    CHECK(extent.box.axes[2].x == doctest::Approx(std::sin(angle)));
    CHECK(dot(cross(extent.box.axes[0], extent.box.axes[1]), extent.box.axes[2]) == doctest::Approx(1));

    LabelSettings labels{{.instance = true}, std::make_shared<const SceneObjects>(objects), {}, {}};
    const Picture p = render_picture(scene, Environment(), view, {.samples = 1, .labels = labels});
    SeenObjects seen;
    seen.look(p.ids.at("instance.ID"), 0, view.width);
    const SeenObject* visible = seen.find(objects.objects[0].id);
    REQUIRE(visible);
    CHECK(std::abs(extent.pixels - visible->pixels) <= 2);  // a ray in float32 may miss an edge by a hair
    // A pixel is seen when its centre is: the box of pixels lies within half a pixel of the box of the projection.
    CHECK(std::abs(visible->left - extent.projected.left) <= 0.51);
    CHECK(std::abs(visible->top - extent.projected.top) <= 0.51);
    CHECK(std::abs(visible->right - extent.projected.right) <= 0.51);
    CHECK(std::abs(visible->bottom - extent.projected.bottom) <= 0.51);
}

TEST_CASE("what stands in front hides a share of an object, and edges of the picture cut its box") {
    Scene scene;
    add_quad(scene, {-2, 0, -10}, {4, 0, 0}, {0, 2, 0}, lambert(Rgb(0.5f)));  // 4 m wide
    add_quad(scene, {-2, 0, -9}, {1, 0, 0}, {0, 2, 0}, lambert(Rgb(0.5f)));   // hides its left quarter and more
    add_quad(scene, {4, 0, -10}, {4, 0, 0}, {0, 2, 0}, lambert(Rgb(0.5f)));   // half beyond the right edge
    add_quad(scene, {-1, 0, 10}, {2, 0, 0}, {0, 2, 0}, lambert(Rgb(0.5f)));   // behind the camera
    for (size_t i = 0; i < 4; ++i) scene.instances[i].name = "quad_" + std::to_string(i);
    const SceneObjects objects = label_objects(scene, {}, {});
    const View view = look_at({0, 1, 0}, {0, 1, -10}, 600, 200, 500);  // the right edge is at x = 6 m
    LabelSettings labels{{.instance = true}, std::make_shared<const SceneObjects>(objects), {}, {}};
    const Picture p = render_picture(scene, Environment(), view, {.samples = 1, .labels = labels});
    SeenObjects seen;
    seen.look(p.ids.at("instance.ID"), 0, view.width);
    const auto list = objects_json(objects, seen, object_extents(scene, objects, view), {}, view, {0, 0, 100});
    REQUIRE(list.size() == 3);
    // From -2/9 to -1/9 of the tangent the front one covers what the rear one has from -0.2 to -0.111 of 0.4.
    CHECK(list[0]["visible_fraction"].get<double>() ==
          doctest::Approx(1 - (0.2 - 1.0 / 9) / 0.4).epsilon(0.01).scale(0));
    CHECK(list[0]["truncated"] == 0);
    CHECK(list[1]["visible_fraction"] == 1);
    CHECK(list[2]["visible_fraction"].get<double>() == doctest::Approx(1).epsilon(0.01));
    CHECK(list[2]["truncated"].get<double>() == doctest::Approx(0.5).epsilon(0.01));
    CHECK(list[2]["amodal_box"][2].get<double>() == doctest::Approx(700));
    CHECK(list[2]["box"][2] == 600);
    CHECK(list[2]["box_3d"]["center"][2].get<double>() == doctest::Approx(90));
}

TEST_CASE("holes of an alpha mask are no part of an object") {
    Scene scene;
    Material leaf = lambert(Rgb(0.5f));
    leaf.alpha_mode = AlphaMode::mask;
    const int quad = add_quad(scene, {-2, 0, -10}, {4, 0, 0}, {0, 2, 0}, leaf);
    Mesh& mesh = scene.meshes[size_t(scene.instances[size_t(quad)].mesh)];
    mesh.colors.assign(mesh.positions.size(), Rgb(1));
    for (const Vec3 p : mesh.positions) mesh.alphas.push_back(p.x < 0 ? 0.0f : 1.0f);  // the left half is cut away
    const SceneObjects objects = label_objects(scene, {}, {});
    const View view = look_at({0, 1, 0}, {0, 1, -10}, 300, 100, 250);
    const ObjectExtent extent = object_extents(scene, objects, view)[0];
    CHECK(double(extent.pixels) == doctest::Approx(0.5 * 100 * 50).epsilon(0.03).scale(0));
}

TEST_CASE("the taxonomy is consistent with itself and with what others publish") {
    const auto& classes = taxonomy();
    std::set<std::string_view> names;
    for (size_t i = 0; i < classes.size(); ++i) {
        const LabelClass& c = classes[i];
        CAPTURE(c.name);
        CHECK(c.id == int(i));
        CHECK(class_id(c.name) == c.id);
        names.insert(c.name);
        CHECK((c.cityscapes_id >= 0 && c.cityscapes_id <= 33));
        CHECK(c.train_id == classes[size_t(c.cityscapes_id)].train_id);
        // CARLA 0.9.14 numbers its first tags as Cityscapes' train ids, plus one.
        if (c.train_id != 255 && c.id < 34) CHECK(c.carla_tag == c.train_id + 1);
        CHECK((c.carla_tag >= 0 && c.carla_tag <= 28));
        CHECK((c.carla_tag_before_0_9_14 >= 0 && c.carla_tag_before_0_9_14 <= 22));
        CHECK((c.coco_id == 0) == c.coco_name.empty());
        CHECK((!c.countable || c.coco_thing));
    }
    CHECK(names.size() == classes.size());
    CHECK(classes[size_t(sky_id)].name == "sky");
    CHECK(class_id("Traffic_Light") == 19);
    CHECK(class_id("nothing of the kind") == -1);
}

}  // namespace pluvia
