// What rays meet: copied and instanced meshes alike, transparency by chance and by mask, no surface that shades itself.
#include "tests/statistics.h"
#include "tests/test_scenes.h"

#include <doctest/doctest.h>

namespace pluvia {
namespace {

/// Rays from a sphere around the scene towards its middle.
Ray random_ray(uint64_t index) {
    const Vec3 from = sample_sphere(uniform_2d(1, index, 0)) * 20.0f;
    const Vec3 to =
        (Vec3(uniform(2, index, 0), uniform(2, index, 1), uniform(2, index, 2)) - Vec3(0.5f, 0.5f, 0.5f)) * 6.0f;
    return {from, normalize(to - from)};
}

}  // namespace

TEST_CASE("a mesh gives the same hits through instances as in copies, also mirrored and stretched") {
    // 40 spheres of 4000 triangles are beyond the limit for copies, 8 are below.
    Scene scene;
    add_sphere(scene, {}, 0.5f, 64, lambert(Rgb(0.5f)));
    const Instance original = scene.instances[0];
    scene.instances.clear();
    for (int i = 0; i < 40; ++i) {
        Instance instance = original;
        instance.scene_from_object = translate({(i % 4) * 1.5 - 2, (i / 4 % 3) * 1.2 - 1, (i / 12) * 1.1 - 1}) *
                                     rotate(0.1 * i, 0.2, 0.3, 1) * scale({i % 2 ? -0.7 : 0.7, 0.4, 0.9});
        scene.instances.push_back(instance);
    }
    Scene copies = scene;  // the same spheres, each as a mesh of its own
    for (int i = 0; i < 40; ++i) {
        copies.meshes.push_back(scene.meshes[0]);
        copies.instances[i].mesh = i + 1;
    }
    const RayScene instanced(scene), copied(copies);
    Counters counters;
    int hits = 0, ties = 0;
    for (uint64_t i = 0; i < 20000; ++i) {
        RayHit a, b;
        const bool hit = instanced.closest_hit(random_ray(i), {}, a, counters);
        const bool hit_copy = copied.closest_hit(random_ray(i), {}, b, counters);
        if (hit != hit_copy) {  // a ray through the very rim
            ++ties;
            continue;
        }
        if (!hit) continue;
        ++hits;
        if (a.point.instance != b.point.instance || a.point.triangle != b.point.triangle)
            ++ties;
        else
            CHECK(a.distance == doctest::Approx(b.distance).epsilon(1e-5).scale(0));
    }
    CHECK(hits > 3000);
    CHECK(ties <= hits / 200);  // rays that meet an edge within rounding
}

TEST_CASE("a surface of opacity 0.3 lets 70 % of the rays pass, and at half none is a surface") {
    Scene scene;
    Material veil = lambert(Rgb(1));
    veil.alpha_mode = AlphaMode::blend, veil.alpha = 0.3f;
    add_quad(scene, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, veil);
    const RayScene rays(scene);
    Counters counters;
    RunningMean passed, open;
    for (uint64_t i = 0; i < 100000; ++i) {
        RayHit hit;
        const Ray ray{{0.1f, 0.2f, 1}, {0, 0, -1}};
        passed.add(!rays.closest_hit(ray, {.key = hash_key(9, i)}, hit, counters));
        open.add(!rays.occluded(ray, {.key = hash_key(10, i)}, counters));
    }
    CHECK(passed.agrees_with(0.7));
    CHECK(open.agrees_with(0.7));
    RayHit hit;
    CHECK_FALSE(rays.closest_hit({{0, 0, 1}, {0, 0, -1}}, {.at_half = true}, hit, counters));
    scene.materials[0].alpha = 0.6f;
    CHECK(RayScene(scene).closest_hit({{0, 0, 1}, {0, 0, -1}}, {.at_half = true}, hit, counters));
}

TEST_CASE("an alpha mask cuts where the texture's alpha is below the cutoff, in copies and instances") {
    Scene scene;
    Material leaf = lambert(Rgb(1));
    leaf.alpha_mode = AlphaMode::mask;
    leaf.base_color_texture = 0;
    scene.images.push_back(Image<Rgba8>(2, 1, Rgba8{255, 255, 255, 255}));
    scene.images[0].pixels[1].a = 0;
    scene.textures.push_back({.image = 0, .nearest = true});
    add_quad(scene, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, leaf);
    for (const bool instanced : {false, true}) {
        if (instanced) {  // enough triangles to be instanced
            Mesh& mesh = scene.meshes[0];
            while (mesh.triangles.size() < 40000) mesh.triangles.insert(mesh.triangles.end(), {{0, 1, 2}, {0, 2, 3}});
            scene.instances.push_back(scene.instances[0]);
            scene.instances[1].scene_from_object = translate({0, 10, 0});
        }
        const RayScene rays(scene);
        Counters counters;
        RayHit hit;
        CHECK(rays.closest_hit({{-0.5f, 0.1f, 1}, {0, 0, -1}}, {}, hit, counters));
        CHECK_FALSE(rays.closest_hit({{0.5f, 0.1f, 1}, {0, 0, -1}}, {}, hit, counters));
        CHECK_FALSE(rays.occluded({{0.5f, 0.1f, 1}, {0, 0, -1}}, {}, counters));
        CHECK(counters[Feature::alpha] > 0);
    }
}

TEST_CASE("no point of a sphere is shaded by the surface it lies on, also a kilometre from the centre") {
    for (const float far : {0.0f, 1000.0f}) {
        Scene scene;
        add_sphere(scene, {far, 0, -far}, 1, 64, lambert(Rgb(0.5f)));
        const RayScene rays(scene);
        Counters counters;
        int shaded = 0, tested = 0;
        for (uint64_t i = 0; i < 50000; ++i) {
            const Vec3 from = Vec3(far, 0, -far) + sample_sphere(uniform_2d(20, i, 0)) * 5.0f;
            const Vec3 to = Vec3(far, 0, -far) + sample_sphere(uniform_2d(21, i, 0)) * 0.5f;
            RayHit hit;
            const Vec3 direction = normalize(to - from);
            if (!rays.closest_hit({from, direction}, {}, hit, counters)) continue;
            const Surface s = evaluate_surface(scene, hit.point, direction, 0.5f, counters);
            ++tested;
            // The outside of a convex body sees no other part of it.
            const Vec3 away = normalize(s.geometric_normal + sample_sphere(uniform_2d(22, i, 0)) * 0.9f);
            shaded +=
                rays.occluded({offset_from_surface(s.position, s.geometric_normal, s.extent), away}, {}, counters);
        }
        CAPTURE(far);
        CHECK(tested > 40000);
        CHECK(shaded == 0);
    }
}

}  // namespace pluvia
