// Labels of small scenes whose classes, places and motion are known.
#include "renderer/scene/taxonomy.h"
#include "renderer/transport/cryptomatte.h"
#include "tests/test_scenes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>

namespace pluvia {
namespace {

constexpr int width = 96, height = 48;

/// Ground, and a box ahead that stands on it; the instances are 0 and 1.
Scene ground_and_box() {
    Scene scene;
    add_quad(scene, {-50, 0, 50}, {100, 0, 0}, {0, 0, -100}, lambert(Rgb(0.2f, 0.4f, 0.6f)));
    add_box(scene, {-1, 0, -9}, {1, 2, -7}, lambert(Rgb(0.5f)));
    scene.instances[0].name = "ground", scene.instances[0].semantic = "road";
    scene.instances[1].name = "traffic/car_1", scene.instances[1].semantic = "car";
    return scene;
}

View ahead() {
    return look_at({0, 1.5f, 0}, {0, 1.5f, -10}, width, height, 80);
}

LabelSettings labels_of(const Scene& scene, LabelLayers layers) {
    LabelSettings settings{layers, std::make_shared<const SceneObjects>(label_objects(scene, {}, {})), {}, {}};
    return settings;
}

LabelLayers all_of_ray() {
    return {.semantic = true, .instance = true, .normals = true, .albedo = true, .position = true, .flow = true};
}

Picture shot(const Scene& scene, const View& view, const LabelSettings& labels, int samples = 1,
             std::vector<double> rain = {}) {
    RenderSettings settings{.samples = samples, .labels = labels};
    settings.rain.intensities_mm_per_h = rain;
    settings.path.max_bounces = 0;
    return render_picture(scene, Environment::uniform(Rgb(1)), view, settings);
}

/// Scene and view at another time of a car that drives, seen by a camera that drives.
struct Moved {
    std::shared_ptr<Scene> scene;
    View view;
};
Moved moved(const Scene& scene, Vec3d car, Vec3d camera) {
    Moved m{std::make_shared<Scene>(scene), ahead()};
    m.scene->instances[1].scene_from_object.translation += car;
    m.view.position += camera;
    return m;
}

}  // namespace

TEST_CASE("every pixel has the class of its instance, and the sky has its own") {
    const Scene scene = ground_and_box();
    LabelSettings labels = labels_of(scene, {.semantic = true, .instance = true});
    const Picture p = shot(scene, ahead(), labels);
    std::set<uint32_t> classes;
    for (size_t i = 0; i < size_t(width) * height; ++i) {
        const uint32_t id = p.ids.at("instance.ID")[i], semantic = p.ids.at("semantic.ID")[i];
        classes.insert(semantic);
        CAPTURE(i);
        if (std::isinf(p.plane("Z")[i])) {
            REQUIRE(id == 0);
            REQUIRE(semantic == uint32_t(sky_id));
        } else {
            REQUIRE((id == instance_id("ground") || id == instance_id("traffic/car_1")));
            REQUIRE(semantic == uint32_t(class_id(id == instance_id("ground") ? "road" : "car")));
        }
    }
    CHECK(classes.size() == 3);
}

TEST_CASE("positions, normals and albedo are those of the surface that depth belongs to") {
    Scene scene = ground_and_box();
    scene.origin = {1000, 20, -300};
    LabelSettings labels = labels_of(scene, {.instance = true, .normals = true, .albedo = true, .position = true});
    const View view = ahead();
    const Picture p = shot(scene, view, labels);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const size_t i = size_t(y) * width + size_t(x);
            const float z = p.plane("Z")[i];
            CAPTURE(x);
            CAPTURE(y);
            const Vec3 position(p.plane("position.X")[i], p.plane("position.Y")[i], p.plane("position.Z")[i]);
            const Vec3 normal(p.plane("N.X")[i], p.plane("N.Y")[i], p.plane("N.Z")[i]);
            if (std::isinf(z)) {
                REQUIRE(std::isinf(position.x));
                REQUIRE(length(normal) == 0);
                continue;
            }
            const Vec3 seen = view.view_direction({float(x) + 0.5f, float(y) + 0.5f}) * z;
            const Vec3d expected = view.position + view.world_vector_from_view(Vec3d(seen)) + scene.origin;
            // Float32 at 1000 m has steps of 6e-5 m; depth at grazing angles of 50 m carries some more.
            REQUIRE(length(Vec3d(position) - expected) < 5e-4);
            REQUIRE(length(normal) == doctest::Approx(1).epsilon(1e-5));
            if (p.ids.at("instance.ID")[i] == instance_id("ground")) {
                REQUIRE(normal.y == doctest::Approx(1));
                REQUIRE(p.plane("albedo.G")[i] == doctest::Approx(0.4f));
            }
        }
}

TEST_CASE("flow of a static scene is what depth and poses say, to a hundredth of a pixel") {
    const Scene scene = ground_and_box();
    LabelSettings labels = labels_of(scene, all_of_ray());
    const Moved next = moved(scene, {}, {0.05, 0.02, -0.4}), previous = moved(scene, {}, {-0.05, 0, 0.4});
    labels.next = OtherFrame{nullptr, next.view}, labels.previous = OtherFrame{nullptr, previous.view};
    const View view = ahead();
    const Picture p = shot(scene, view, labels);
    int seen = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const size_t i = size_t(y) * width + size_t(x);
            const float z = p.plane("Z")[i];
            if (std::isinf(z)) {
                REQUIRE(p.plane("flow_fwd.U")[i] == doctest::Approx(0).epsilon(1e-3));
                continue;
            }
            for (const auto& [layer, other] : {std::pair{"flow_fwd", &next.view}, {"flow_bwd", &previous.view}}) {
                const Vec3d world =
                    view.position +
                    view.world_vector_from_view(Vec3d(view.view_direction({float(x) + 0.5f, float(y) + 0.5f}) * z));
                const Vec3d there = other->view_from_world(world);
                if (there.z <= 0) continue;
                const Vec2 to = other->pixel_from_view(Vec3(there));
                CAPTURE(x);
                CAPTURE(y);
                CAPTURE(layer);
                REQUIRE(std::abs(p.plane(layer + std::string(".U"))[i] - (to.x - float(x) - 0.5f)) < 0.01f);
                REQUIRE(std::abs(p.plane(layer + std::string(".V"))[i] - (to.y - float(y) - 0.5f)) < 0.01f);
                ++seen;
            }
        }
    CHECK(seen > 2000);
}

TEST_CASE("forward flow leads to a pixel of the next frame from which backward flow leads back") {
    // Which way flow points is a matter of sign that data sets disagree on: a car that drives to the right has U > 0.
    const Scene scene = ground_and_box();
    const View view = ahead();
    LabelSettings labels = labels_of(scene, all_of_ray());
    const Moved next = moved(scene, {0.6, 0, 0}, {0, 0, -0.3});
    labels.next = OtherFrame{next.scene, next.view}, labels.previous = OtherFrame{nullptr, view};
    const Picture now = shot(scene, view, labels);
    LabelSettings later = labels_of(*next.scene, all_of_ray());
    later.previous = OtherFrame{std::make_shared<Scene>(scene), view}, later.next = OtherFrame{nullptr, next.view};
    const Picture then = shot(*next.scene, next.view, later);
    int checked = 0, hidden = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const size_t i = size_t(y) * width + size_t(x);
            const float u = now.plane("flow_fwd.U")[i], v = now.plane("flow_fwd.V")[i];
            const auto visibility = FlowVisibility(int(now.plane("flow_fwd.occlusion")[i]));
            if (now.ids.at("instance.ID")[i] == instance_id("traffic/car_1")) REQUIRE(u > 2);
            hidden += visibility == FlowVisibility::hidden;
            if (visibility != FlowVisibility::visible || std::isinf(now.plane("Z")[i])) continue;
            const int tx = int(float(x) + 0.5f + u), ty = int(float(y) + 0.5f + v);
            const size_t t = size_t(ty) * width + size_t(tx);
            if (then.ids.at("instance.ID")[t] != now.ids.at("instance.ID")[i]) continue;  // half a pixel off an edge
            CAPTURE(x);
            CAPTURE(y);
            // The flow there is that of the pixel's centre, up to 0.7 px away, where it may differ by a tenth.
            if (then.plane("flow_bwd.occlusion")[t] == 0) {
                REQUIRE(std::abs(u + then.plane("flow_bwd.U")[t]) < 0.5f);
                ++checked;
            }
        }
    CHECK(checked > 1000);
    CHECK(hidden > 20);  // the ground that the car drives in front of
}

TEST_CASE("what the camera leaves behind or turns away from has no place in the other frame") {
    const Scene scene = ground_and_box();
    LabelSettings labels = labels_of(scene, all_of_ray());
    View past = ahead(), turned = ahead();
    past.position += Vec3d(0, 0, -20);  // the box is behind it
    std::swap(turned.right, turned.back);
    turned.right = turned.right * -1.0;  // looks to the side
    labels.next = OtherFrame{nullptr, past}, labels.previous = OtherFrame{nullptr, turned};
    const Picture p = shot(scene, ahead(), labels);
    const auto box =
        size_t(std::find(p.ids.at("instance.ID").begin(), p.ids.at("instance.ID").end(), instance_id("traffic/car_1")) -
               p.ids.at("instance.ID").begin());
    REQUIRE(box < p.ids.at("instance.ID").size());
    CHECK(p.plane("flow_fwd.occlusion")[box] == float(FlowVisibility::behind));
    CHECK(p.plane("flow_fwd.U")[box] == 0);
    CHECK(p.plane("flow_bwd.occlusion")[box] != float(FlowVisibility::visible));
    for (const auto& [name, plane] : p.planes)
        for (const float v : plane) REQUIRE(!std::isnan(v));
}

TEST_CASE("labels change no byte of light and depth, and cost nothing when off") {
    const Scene scene = ground_and_box();
    LabelSettings labels = labels_of(scene, all_of_ray());
    labels.layers.cryptomatte = true;
    labels.next = labels.previous = OtherFrame{nullptr, ahead()};
    const Picture with = shot(scene, ahead(), labels, 4, {50}), without = shot(scene, ahead(), {}, 4, {50});
    for (const auto& [name, plane] : without.planes) {
        CAPTURE(name);
        CHECK(plane == with.plane(name));
    }
    CHECK(without.report.counters[Feature::label] == 0);
    CHECK(without.report.counters[Feature::matte] == 0);
    CHECK(with.report.counters[Feature::label] == uint64_t(width) * height);
    CHECK(with.report.counters[Feature::matte] > 0);
}

TEST_CASE("ids of mattes are those that Cryptomatte's specification gives") {
    // MurmurHash3_x86_32 with seed 0; the first from SMHasher's verification of short keys, the others from the
    // specification's example of a manifest.
    CHECK(murmur_hash("") == 0);
    CHECK(murmur_hash("hello") == 0x248bfa47);
    CHECK(murmur_hash("hello, world") == 0x149bbb7f);
    CHECK(murmur_hash("The quick brown fox jumps over the lazy dog") == 0x2e4ff723);
    // No name has an id that is not finite, zero or denormal.
    for (int i = 0; i < 20000; ++i) {
        const float id = cryptomatte_id("name " + std::to_string(i));
        REQUIRE(std::isnormal(id));
    }
}

TEST_CASE("mattes are the share of samples that show an object, and rain is one of its own") {
    const Scene scene = ground_and_box();
    LabelSettings labels = labels_of(scene, {.instance = true, .cryptomatte = true});
    const int samples = 64;
    const Picture p = shot(scene, ahead(), labels, samples, {50});
    const float car = cryptomatte_id("traffic/car_1"), rain = cryptomatte_id("rain");
    double area = 0, rain_area = 0, centre_area = 0;
    int partial = 0;
    for (size_t i = 0; i < size_t(width) * height; ++i) {
        float total = 0, last = 2;
        for (const auto& [id, coverage] : {std::pair{"CryptoObject00.R", "CryptoObject00.G"},
                                           {"CryptoObject00.B", "CryptoObject00.A"},
                                           {"CryptoObject01.R", "CryptoObject01.G"}}) {
            const float c = p.plane(coverage)[i];
            REQUIRE(c <= last);
            last = c, total += c;
            REQUIRE(p.plane(id)[i] != rain);
            if (p.plane(id)[i] == car) area += c, partial += c < 1;
        }
        REQUIRE(total <= 1.0001f);
        REQUIRE(p.plane("CryptoRain_050_00.G")[i] == p.plane("rain_050.A")[i]);
        REQUIRE((p.plane("CryptoRain_050_00.G")[i] == 0 || p.plane("CryptoRain_050_00.R")[i] == rain));
        rain_area += p.plane("CryptoRain_050_00.G")[i];
        centre_area += p.ids.at("instance.ID")[i] == instance_id("traffic/car_1");
    }
    // The front of the box, 2 m x 2 m at 7 m, and nothing else of it: the lid is above the eye.
    const double exact = 2 * 80.0 / 7 * 2 * 80.0 / 7;
    // Each of some 90 pixels along its edge is off by less than 0.5 sqrt(1/64); their sum by five times sqrt(90) that.
    CHECK(std::abs(area - exact) < 5 * std::sqrt(90.0) * 0.5 / std::sqrt(double(samples)));
    CHECK(std::abs(centre_area - exact) < 60);  // whole pixels
    CHECK(partial > 30);                        // soft edges
    CHECK(rain_area > 0);
}

TEST_CASE("Cryptomatte's header holds every name under a key made of the layer's hash") {
    const auto header = cryptomatte_header("CryptoObject", {"traffic/car_1", "quoted \"name\""});
    REQUIRE(header.size() == 4);
    const std::string key = header.begin()->first.substr(0, header.begin()->first.rfind('/'));
    CHECK(key.size() == std::string("cryptomatte/1234567").size());
    CHECK(header.at(key + "/name") == "CryptoObject");
    CHECK(header.at(key + "/hash") == "MurmurHash3_32");
    CHECK(header.at(key + "/conversion") == "uint32_to_float32");
    CHECK(header.at(key + "/manifest").find("\"quoted \\\"name\\\"\":\"") != std::string::npos);
}

}  // namespace pluvia
