// A frame's labels are checked against each other: what is right passes, what is bent is found.
#include "tools/labels/label_check.h"
#include "tests/label_fixture.h"

#include <doctest/doctest.h>

#include <cmath>

namespace pluvia {

TEST_CASE("a rendered frame fulfils its own check, and one that is bent does not") {
    const TemporaryFolder folder;
    const LabelSource source = render_labels(folder, labelled_street(), "frame", 3, "--rain 50");
    LabelFrame frame(source);
    const LabelCheck good = check_labels(frame);
    CHECK(good.faults == std::vector<std::string>());
    CHECK(good.labelled_pixels == 192 * 96);
    CHECK(good.boxes >= 7);
    CHECK(good.flow_pixels > 20000);
    CHECK(good.largest_flow_error < 0.01);
    const auto faults_with = [&](auto bend) {
        LabelFrame bent(source);
        bend(bent);
        const auto faults = check_labels(bent).faults;
        return faults.empty() ? std::string() : faults[0];
    };
    const auto car = [](LabelFrame& f) -> FrameObject& {
        for (FrameObject& o : f.objects)
            if (o.name == "traffic/car_1") return o;
        return f.objects[0];
    };
    CHECK(faults_with([&](LabelFrame& f) { car(f).class_id = 27; }).find("is not that of its instance") !=
          std::string::npos);
    CHECK(faults_with([&](LabelFrame& f) { car(f).json["box"][0] = 3; }).find("does not hug") != std::string::npos);
    CHECK(faults_with([&](LabelFrame& f) { car(f).json["amodal_box"][2] = 3; }).find("amodal box") !=
          std::string::npos);
    CHECK(faults_with([&](LabelFrame& f) { car(f).json["box_3d"]["size"][2] = 3; }).find("3D box") !=
          std::string::npos);
    CHECK(faults_with([&](LabelFrame& f) {
              auto& x = f.json["camera"]["world_from_camera_next"][0][3];
              x = x.get<double>() + 0.05;
          }).find("does not agree with depth and poses") != std::string::npos);
}

TEST_CASE("flow of what moves is what depth, poses and the motions of objects say, part by part") {
    const TemporaryFolder folder;
    // A car that turns as it drives, and a person whose body and arm move on their own.
    Scene scene = labelled_street();
    const int arm = add_box(scene, {1.0f, 1.0f, -6.2f}, {1.1f, 1.6f, -6.0f}, lambert(Rgb(0.5f)));
    scene.instances[size_t(arm)].name = "people/person_1/arm";
    std::vector<NodeMotion> motions;
    for (Instance& instance : scene.instances) {
        if (instance.name == "people/person_1") instance.name = "people/person_1/body";
        const bool is_car = instance.name == "traffic/car_2", is_arm = instance.name.ends_with("/arm");
        if (!is_car && !is_arm && !instance.name.ends_with("/body")) continue;
        instance.id = instance_id(instance.name), instance.semantic = is_car ? "car" : "person";
        // About points inside: coordinates of these boxes are the scene's.
        const Vec3d middle = is_car ? Vec3d(2.9, 0, -9) : Vec3d(1.05, 1.6, -6.1);
        NodeMotion motion{instance.name, is_car ? "" : "people/person_1", {}, {}};
        for (int k = 0; k <= 10; ++k) {
            const double angle = 0.05 * k * (is_car ? 1 : 0), swing = 0.1 * k * (is_arm ? 1 : 0);
            motion.times.push_back(0.1f * float(k));
            motion.scene_from_object.push_back(translate(middle + Vec3d(-0.05 * k, 0, is_car ? 0.2 * k : 0)) *
                                               rotate(0, std::sin(angle / 2), 0, std::cos(angle / 2)) *
                                               rotate(std::sin(swing / 2), 0, 0, std::cos(swing / 2)) *
                                               translate(middle * -1.0));
        }
        instance.scene_from_object = motion.scene_from_object[0];
        motions.push_back(motion);
    }
    scene.cameras.push_back({"side", translate({1.5, 2, 3}), 0.9});
    const LabelSource source = render_labels(folder, scene, "moving", 4, "--camera drive", motions);
    LabelFrame frame(source);
    const LabelCheck check = check_labels(frame);
    CHECK(check.faults == std::vector<std::string>());
    CHECK(check.moving_pixels > 1500);  // both flows
    CHECK(check.left_out_pixels == 0);
    CHECK(check.largest_flow_error < 0.01);
    const auto find = [&](LabelFrame& f, const std::string& name) -> FrameObject& {
        for (FrameObject& o : f.objects)
            if (o.name == name) return o;
        FAIL("there is no object " << name);
        return f.objects[0];
    };
    CHECK(find(frame, "people/person_1").json.at("motion_next").size() == 2);
    CHECK(find(frame, "traffic/car_2").json.at("motion_next").size() == 1);
    CHECK(!find(frame, "traffic/car_1").moves);
    // Where nobody says which pixels move, flow of these is not held against depth and poses, and that of the rest is.
    const Outcome outcome = run_program("render " + (folder / "moving.glb") + " -o " + (folder / "unnamed") +
                                        " --camera drive --frame 4 --fps 10 --size 192x96 --spp 1 --bounces 0"
                                        " --environment 100,100,100 --layers flow --progress none");
    REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
    LabelFrame unnamed(label_source(folder / "unnamed"));
    const LabelCheck of_unnamed = check_labels(unnamed);
    CHECK(of_unnamed.faults == std::vector<std::string>());
    CHECK(of_unnamed.left_out_pixels > 100);
    CHECK(of_unnamed.flow_pixels + of_unnamed.left_out_pixels == check.flow_pixels);
    // Another camera at another time sees the same ids.
    LabelFrame other(render_labels(folder, scene, "moved", 8, "--camera side", motions));
    CHECK(check_labels(other).faults == std::vector<std::string>());
    size_t in_both = 0;
    for (const FrameObject& a : frame.objects)
        for (const FrameObject& b : other.objects) {
            CHECK((a.name == b.name) == (a.id == b.id));
            if (a.name != b.name) continue;
            ++in_both;
            CHECK(a.number == b.number);
            CHECK(a.index == b.index);
        }
    CHECK(in_both >= 6);
    // At rest in the picture of the check, where it is not in truth: more than 0.1 pixel off.
    LabelFrame still(source);
    for (FrameObject& o : still.objects) o.moves = false;
    CHECK(!check_labels(still).faults.empty());
    LabelFrame bent(source);
    auto& x = find(bent, "traffic/car_2").json["motion_previous"][0][3];
    x = x.get<double>() + 0.05;
    const auto faults = check_labels(bent).faults;
    REQUIRE(!faults.empty());
    CHECK(faults[0].find("flow_bwd") != std::string::npos);
}

}  // namespace pluvia
