// Labels in the layouts of other datasets, read back by Pluvia and by a reader that shares no code with it.
#include "tools/labels/label_export.h"
#include "renderer/image/depth_encoding.h"
#include "renderer/image/image_io.h"
#include "tests/error_of.h"
#include "tests/label_fixture.h"
#include "tools/labels/coco.h"
#include "tools/labels/flow_file.h"
#include "tools/labels/flow_layer.h"
#include "tools/labels/outline.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>

namespace pluvia {
namespace {

using Json = nlohmann::ordered_json;

/// One frame for all tests of this file: a render of a second.
struct Shot {
    TemporaryFolder folder;
    LabelSource source = render_labels(folder, labelled_street(), "frame", 3, "--rain 50");
    LabelFrame frame{source};
};
Shot& shot() {
    static Shot shared;
    return shared;
}

std::string exported(const std::string& format) {
    const std::string to = shot().folder / format;
    export_labels({shot().source}, format, to);
    return to;
}

const FrameObject& object(const std::string& name) {
    for (const FrameObject& o : shot().frame.objects)
        if (o.name == name) return o;
    FAIL("there is no object " << name);
    return shot().frame.objects[0];
}

/// Paints polygons in their order: pixels whose centre is inside by the even-odd rule.
std::vector<uint32_t> painted(const std::vector<Outline>& list, int width, int height) {
    std::vector<uint32_t> ids(size_t(width) * size_t(height), 0xffffffff);
    for (const Outline& outline : list)
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                bool inside = false;
                for (size_t i = 0; i < outline.points.size(); ++i) {
                    const auto &a = outline.points[i], &b = outline.points[(i + 1) % outline.points.size()];
                    if ((a[1] > y) != (b[1] > y) && a[0] > x) inside = !inside;  // edges are vertical where they count
                }
                if (inside) ids[size_t(y) * size_t(width) + size_t(x)] = outline.id;
            }
    return ids;
}

}  // namespace

TEST_CASE("outlines painted in their order give every pixel its id back, holes and diagonal neighbours included") {
    const std::vector<uint32_t> ids = {
        1, 1, 1, 1, 1, 1, 2, 2,  //
        1, 3, 3, 3, 1, 1, 2, 1,  //
        1, 3, 1, 3, 1, 2, 1, 2,  //
        1, 3, 4, 3, 1, 1, 2, 2,  //
        1, 3, 3, 3, 3, 1, 5, 2,  //
        1, 1, 1, 1, 3, 1, 2, 5,  //
    };
    const auto list = outlines(ids, 8);
    CHECK(painted(list, 8, 6) == ids);
    for (const Outline& outline : list)
        for (size_t i = 0; i < outline.points.size(); ++i) {
            const auto &a = outline.points[i], &b = outline.points[(i + 1) % outline.points.size()];
            CHECK(((a[0] == b[0]) != (a[1] == b[1])));
        }
    // Noise of three ids: every kind of corner.
    std::vector<uint32_t> noise;
    for (uint32_t i = 0; i < 40 * 30; ++i) noise.push_back((i * 2654435761u >> 16) % 3);
    CHECK(painted(outlines(noise, 40), 40, 30) == noise);
}

TEST_CASE("run lengths of a mask lead back to it") {
    std::vector<uint32_t> ids;
    for (uint32_t i = 0; i < 7 * 5; ++i) ids.push_back((i * 2654435761u >> 13) % 2);
    for (const uint32_t id : {0u, 1u, 2u}) {
        const auto mask = mask_from_run_lengths(run_lengths(ids, 7, id), 7, 5);
        for (size_t i = 0; i < ids.size(); ++i) REQUIRE(mask[i] == (ids[i] == id));
    }
    // By hand: columns 0 1 | 1 1 | 0 0 of a picture of two rows.
    CHECK(run_lengths({0, 1, 0, 1, 1, 0}, 3, 1) == std::vector<int64_t>{1, 3, 2});
    CHECK_THROWS(mask_from_run_lengths({1, 3}, 3, 2));
    CHECK_THROWS(mask_from_run_lengths({1, 3, 9}, 3, 2));
}

TEST_CASE("flow files are read back as they were written") {
    Flow flow{3, 2, {0, 1.25f, -511.9f, 3, 0, 700}, {0, -2.5f, 511.9f, 4, 0, 1}, {1, 1, 1, 0, 1, 1}};
    const TemporaryFolder folder;
    write_flo(folder / "a.flo", flow);
    const Flow flo = read_flo(folder / "a.flo");
    CHECK(flo.u[1] == 1.25f);
    CHECK(flo.v[2] == 511.9f);
    CHECK(flo.valid == flow.valid);
    CHECK(read_file(folder / "a.flo").substr(0, 4) == "PIEH");
    write_kitti_flow(folder / "a.png", flow);
    const Flow kitti = read_kitti_flow(folder / "a.png");
    CHECK(kitti.valid == std::vector<uint8_t>{1, 1, 1, 0, 1, 0});  // 700 pixels are beyond 16 bits
    for (size_t i = 0; i < 5; ++i)
        if (kitti.valid[i]) CHECK(std::abs(kitti.u[i] - flow.u[i]) <= 1.0f / 128);
    CHECK(kitti.u[0] == 0);
    write_file(folder / "b.flo", "PIEH....");
    CHECK(error_of([&] { read_flo(folder / "b.flo"); }).code() == ExitCode::input);
    CHECK(error_of([&] { read_kitti_flow(folder / "b.flo"); }).code() == ExitCode::input);
}

TEST_CASE("Cityscapes: ids of classes and instances, and outlines that are no convex hulls") {
    const std::string stem = exported("cityscapes") + "/frame_gtFine_";
    CHECK(read_image_info(stem + "instanceIds.png").bits == 16);
    CHECK(read_image_info(stem + "labelIds.png").channels == 1);
    const auto ids = read_rgba8(stem + "labelIds.png"), train = read_rgba8(stem + "labelTrainIds.png"),
               color = read_rgba8(stem + "color.png");
    const auto instances = read_grey16(stem + "instanceIds.png");
    const auto semantic = shot().frame.ids("semantic.ID"), id = shot().frame.ids("instance.ID");
    const uint32_t car_2 = object("traffic/car_2").id, person = object("people/person_1").id,
                   group = object("poles/group_1").id, pole = object("poles/pole_1").id;
    int64_t seen[4] = {};
    for (size_t i = 0; i < id.size(); ++i) {
        REQUIRE(ids.pixels[i].r == semantic[i]);
        const int label = ids.pixels[i].r, trained = train.pixels[i].r, instance = instances.pixels[i];
        if (id[i] == car_2) {
            REQUIRE((instance == 26001 && trained == 13));
            ++seen[0];
        }
        if (id[i] == person) {
            REQUIRE((instance == 24000 && trained == 11));
            ++seen[1];
        }
        // These two share a colour, and nothing else.
        if (id[i] == pole) {
            REQUIRE((label == 17 && trained == 5 && color.pixels[i].g == 153 && instance == 17));
            ++seen[2];
        }
        if (id[i] == group) {
            REQUIRE((label == 18 && trained == 255 && color.pixels[i].g == 153 && instance == 18));
            ++seen[3];
        }
        if (id[i] == 0) REQUIRE(instances.pixels[i] == 23);
    }
    for (const int64_t count : seen) CHECK(count > 100);
    const Json polygons = Json::parse(read_file(stem + "polygons.json"));
    CHECK(polygons.at("imgWidth") == 192);
    std::vector<Outline> list;
    for (const auto& entry : polygons.at("objects")) {
        Outline outline{uint32_t(class_id(entry.at("label").get<std::string>())), {}, 0};
        for (const auto& point : entry.at("polygon")) outline.points.push_back({point.at(0), point.at(1)});
        list.push_back(outline);
    }
    CHECK(painted(list, 192, 96) == semantic);  // points are [x, y]: else this picture would be another
}

TEST_CASE("CARLA: tags of either version in red, depth linear in 24 bits") {
    for (const auto& [format, car, road, sky] :
         {std::tuple{"carla", 14, 1, 11}, std::tuple{"carla-0.9.13", 10, 7, 13}}) {
        const std::string folder = exported(format);
        const auto tags = read_rgba8(folder + "/semantic/frame.png"),
                   instance = read_rgba8(folder + "/instance/frame.png"),
                   depth = read_rgba8(folder + "/depth/frame.png");
        const auto id = shot().frame.ids("instance.ID");
        const auto z = shot().frame.values("Z");
        const FrameObject& car_2 = object("traffic/car_2");
        int64_t cars = 0;
        for (size_t i = 0; i < id.size(); ++i) {
            if (id[i] == 0) REQUIRE(tags.pixels[i].r == sky);
            if (id[i] == object("ground/road").id) REQUIRE(tags.pixels[i].r == road);
            if (id[i] == car_2.id) {
                REQUIRE(tags.pixels[i].r == car);
                REQUIRE(instance.pixels[i].r == car);
                REQUIRE(instance.pixels[i].g + 256 * instance.pixels[i].b == car_2.index + 1);
                ++cars;
            }
            const float metres = decode_carla24(depth.pixels[i]);
            REQUIRE((std::isinf(z[i]) ? std::isinf(metres) : std::abs(metres - z[i]) < 1e-4f));
        }
        CHECK(cars > 100);
    }
}

TEST_CASE("COCO: masks, boxes and segments agree with the instances") {
    const std::string folder = exported("coco");
    const Json all = Json::parse(read_file(folder + "/instances.json"));
    const auto ids = shot().frame.ids("instance.ID");
    int things = 0;
    for (const auto& annotation : all.at("annotations")) {
        const auto counts = annotation.at("segmentation").at("counts").get<std::vector<int64_t>>();
        const auto mask = mask_from_run_lengths(counts, 192, 96);
        int64_t area = 0;
        uint32_t id = 0;
        for (size_t i = 0; i < mask.size(); ++i)
            if (mask[i]) {
                REQUIRE((id == 0 || ids[i] == id));
                id = ids[i], ++area;
            }
        CHECK(annotation.at("area") == area);
        const int index = shot().frame.object_of(id);
        REQUIRE(index >= 0);
        CHECK(annotation.at("category_id") == shot().frame.objects[size_t(index)].label().coco_id);
        ++things;
    }
    CHECK(things == 3);
    const Json panoptic = Json::parse(read_file(folder + "/panoptic.json"));
    const auto picture = read_rgba8(folder + "/panoptic/frame.png");
    std::map<uint32_t, int64_t> areas;
    for (const Rgba8 p : picture.pixels) ++areas[p.r + 256u * p.g + 65536u * p.b];
    for (const auto& segment : panoptic.at("annotations").at(0).at("segments_info")) {
        CHECK(areas.at(segment.at("id")) == segment.at("area"));
        areas.erase(segment.at("id"));
    }
    areas.erase(0);  // poles: COCO has no category for them
    CHECK(areas.empty());
}

TEST_CASE("KITTI: boxes in the camera's frame project onto the boxes in the picture") {
    const std::string folder = exported("kitti");
    std::istringstream labels(read_file(folder + "/label_2/frame.txt"));
    std::map<std::string, std::vector<std::array<double, 14>>> found;
    for (std::string type; labels >> type;)
        for (double& v : found[type].emplace_back()) labels >> v;
    REQUIRE(found.size() == 2);  // KITTI has no type for the others
    REQUIRE(found["Car"].size() == 2);
    REQUIRE(found["Pedestrian"].size() == 1);
    // truncated, occluded, alpha, left, top, right, bottom, h, w, l, x, y, z, rotation_y. After 0.3 s the camera is at
    // 0.06, 1.5, -0.6; the car stands at -1.3, 0, -10, 1.8 wide and 4 long, and faces the camera: a quarter turn.
    const auto& car = found["Car"][0];
    const double expected[] = {1.4, 1.8, 4, -1.36, 1.5, 9.4, pi / 2};
    for (size_t k = 0; k < 7; ++k) {
        CAPTURE(k);
        CHECK(car[7 + k] == doctest::Approx(expected[k]).epsilon(1e-3));
    }
    CHECK(car[2] == doctest::Approx(pi / 2 - std::atan2(-1.36, 9.4)).epsilon(1e-3).scale(0));
    CHECK(car[0] == 0);
    const Flow occ = read_kitti_flow(folder + "/flow_occ/frame.png"),
               noc = read_kitti_flow(folder + "/flow_noc/frame.png");
    const auto u = shot().frame.values("flow_fwd.U"), occlusion = shot().frame.values("flow_fwd.occlusion");
    for (size_t i = 0; i < u.size(); ++i) {
        REQUIRE(bool(noc.valid[i]) == (occlusion[i] == 0));
        REQUIRE(std::abs(occ.u[i] - u[i]) <= 1.0f / 128);
    }
}

TEST_CASE("exports are read by programs that share no code with Pluvia") {
    if (std::system("/usr/bin/python3 -c 'import numpy, PIL' 2>/dev/null") != 0) {
        MESSAGE("skipped: apt-get install python3-numpy python3-pil");
        return;
    }
    const TemporaryFolder truth;
    LabelFrame& frame = shot().frame;
    for (const char* channel : {"semantic.ID", "instance.ID"}) {
        const auto plane = frame.ids(channel);
        write_file(truth / channel, {reinterpret_cast<const char*>(plane.data()), plane.size() * 4});
    }
    for (const char* channel :
         {"Z", "flow_fwd.U", "flow_fwd.V", "flow_fwd.occlusion", "flow_bwd.U", "flow_bwd.V", "flow_bwd.occlusion"}) {
        const auto plane = frame.values(channel);
        write_file(truth / channel, {reinterpret_cast<const char*>(plane.data()), plane.size() * 4});
    }
    write_file(truth / "frame.json", frame.json.dump());
    std::filesystem::copy_file(shot().source.exr, truth / "frame.exr");
    for (const std::string& format : label_formats()) export_labels({shot().source}, format, truth / format);
    const std::string script = std::string(PLUVIA_SOURCE_DIR) + "/tests/label_readers.py";
    const std::string log = truth / "log";
    const int status = std::system(("/usr/bin/python3 " + script + " " + truth.path() + " >" + log + " 2>&1").c_str());
    const std::string text = read_file(log);
    CHECK_MESSAGE(status == 0, text);
    MESSAGE(text);
}

TEST_CASE("frames that cannot be exported are refused by name") {
    const auto refused = [](const std::string& arguments) { return run_program("labels export " + arguments); };
    const std::string to = " -o " + (shot().folder / "refused");
    Outcome outcome = refused(shot().folder / "frame" + to + " --format cityscape");
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.err.find("there is no format \"cityscape\"") != std::string::npos);
    const std::string plain = shot().folder / "plain";
    REQUIRE(run_program("render " + (shot().folder / "frame.glb") + " -o " + plain +
                        " --size 16x8 --spp 1 --bounces 0 --environment 1,1,1 --progress none --layers semantic")
                .exit_code == 0);
    outcome = refused(plain + to + " --format coco");
    CHECK(outcome.exit_code == 3);
    CHECK(outcome.err.find("--layers instance") != std::string::npos);
    const std::string twice = shot().folder / "frame";
    CHECK(refused(twice + " " + twice + "/" + to + " --format flo").exit_code == 2);
    CHECK(run_program("labels check " + twice).exit_code == 0);
}

}  // namespace pluvia
