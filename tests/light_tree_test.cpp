// The light tree: its probabilities are those with which it chooses, and no light that contributes is left out.
#include "renderer/scene/lights.h"
#include "tests/statistics.h"
#include "tests/test_scenes.h"

#include <doctest/doctest.h>

#include <array>

namespace pluvia {
namespace {

Vec3 random_point(uint64_t seed, uint64_t index, float size) {
    return Vec3(uniform(seed, index, 0) - 0.5f, uniform(seed, index, 1) - 0.5f, uniform(seed, index, 2) - 0.5f) * size;
}
Vec3 random_direction(uint64_t seed, uint64_t index) {
    return sample_sphere(uniform_2d(seed, index, 10));
}

std::vector<LightBounds> random_lights(int count) {
    std::vector<LightBounds> lights;
    for (uint64_t i = 0; i < uint64_t(count); ++i) {
        LightBounds b;
        const Vec3 p = random_point(1, i, 20);
        b.lower = p, b.upper = p + Vec3(uniform(2, i, 0), uniform(2, i, 1), uniform(2, i, 2)) * 0.5f;
        b.axis = random_direction(3, i);
        b.cos_spread = i % 3 == 0 ? -1.0f : 1.0f;
        b.cos_emission = i % 3 == 1 ? 0.7f : 0.0f;
        b.two_sided = i % 2 == 0;
        b.power = i == 5 ? 0.0f : 0.1f + 10 * uniform(4, i, 0);
        lights.push_back(b);
    }
    return lights;
}

Receiver random_receiver(uint64_t index) {
    return {random_point(50, index, 24), index % 2 ? random_direction(51, index) : Vec3()};
}

}  // namespace

TEST_CASE("lights are chosen with the probability that is reported for them") {
    const auto lights = random_lights(60);
    const LightTree tree(lights);
    for (uint64_t r = 0; r < 6; ++r) {
        const Receiver receiver = random_receiver(r);
        std::vector<double> observed(lights.size() + 1, 0.0), expected(lights.size() + 1, 0.0);
        constexpr int n = 40000;
        for (uint64_t i = 0; i < n; ++i) {
            const auto choice = tree.choose(receiver, uniform(60 + r, i, 0));
            ++observed[choice ? size_t(choice->light) : lights.size()];
            if (choice)
                CHECK(choice->probability ==
                      doctest::Approx(tree.probability(receiver, choice->light)).epsilon(1e-4).scale(0));
        }
        double sum = 0;
        for (size_t k = 0; k < lights.size(); ++k) sum += expected[k] = n * double(tree.probability(receiver, int(k)));
        expected.back() = std::max(0.0, n - sum);  // subtrees that turn out not to reach the receiver
        CAPTURE(r);
        CHECK(sum <= n * (1 + 1e-5));
        CHECK(chi_square_test(observed, expected).p_value > five_sigma_p_value);
    }
}

TEST_CASE("lights chosen side by side are those that are chosen one by one") {
    const LightTree tree(random_lights(300));
    for (uint64_t r = 0; r < 500; ++r) {
        const Receiver receiver = random_receiver(r);
        const float u = uniform(90, r, 0);
        std::array<LightTree::Choice, 8> choices;
        tree.choose(receiver, u, choices);
        for (size_t i = 0; i < choices.size(); ++i) {
            const auto alone = tree.choose(receiver, std::min((float(i) + u) / 8, 0x1.fffffep-1f));
            CHECK(choices[i].light == (alone ? alone->light : -1));
            if (alone) CHECK(choices[i].probability == alone->probability);
        }
    }
}

TEST_CASE("a light that reaches a receiver is never left out, one without power always") {
    const auto lights = random_lights(200);
    const LightTree tree(lights);
    CHECK(tree.probability(random_receiver(0), 5) == 0);
    int reached = 0;
    for (uint64_t r = 0; r < 300; ++r) {
        const Receiver receiver = random_receiver(r);
        for (size_t k = 0; k < lights.size(); ++k) {
            const LightBounds& b = lights[k];
            if (b.power == 0) continue;
            // A point of the light, and whether it shines at the receiver and is above its horizon.
            const Vec3 d = b.upper - b.lower;
            const Vec3 p = b.lower + Vec3(d.x * uniform(70, r, k), d.y * uniform(71, r, k), d.z * uniform(72, r, k));
            const Vec3 w = normalize(receiver.position - p);
            float cosine = dot(w, b.axis);
            if (b.two_sided) cosine = std::abs(cosine);
            const bool shines = b.cos_spread == -1 || cosine > b.cos_emission;
            const bool above = receiver.normal == Vec3() || -dot(w, receiver.normal) > 0;
            if (!shines || !above) continue;
            ++reached;
            CHECK(tree.probability(receiver, int(k)) > 0);
        }
    }
    CHECK(reached > 10000);
}

TEST_CASE("near a lamp the tree chooses that lamp far more often than its share") {
    const auto lights = random_lights(60);
    const LightTree tree(lights);
    const Receiver receiver{lights[0].upper + Vec3(0.2f, 0, 0), Vec3()};
    float power = 0;
    for (const LightBounds& b : lights) power += b.power;
    CHECK(tree.probability(receiver, 0) > 5 * lights[0].power / power);
}

TEST_CASE("the pdf of a point on an emissive triangle is that of sampling it") {
    Scene scene;
    for (int i = 0; i < 5; ++i)
        add_sphere(scene, {float(i), 1 + 0.3f * float(i), float(i % 2)}, 0.2f, 8, emitter(Rgb(float(1 + i))));
    const Environment black;
    const Lights lights(scene, black);
    const RayScene ray_scene(scene);
    Counters counters;
    const Receiver receiver{{1.5f, 0, 0.3f}, {0, 1, 0}};
    int compared = 0;
    for (uint64_t i = 0; i < 2000; ++i) {
        const auto point = lights.choose_local(receiver, uniform(80, i, 0), uniform_2d(80, i, 1));
        if (!point) continue;
        const LightSample light = lights.illuminate(receiver.position, *point);
        if (is_black(light.radiance)) continue;
        RayHit hit;
        if (!ray_scene.closest_hit({receiver.position, light.wi}, {}, hit, counters)) continue;
        if (std::abs(hit.distance - light.distance) > 1e-4f) continue;  // another one stands in front
        ++compared;
        CHECK(lights.pdf_local(receiver, hit.point) == doctest::Approx(light.pdf).epsilon(2e-3).scale(0));
    }
    CHECK(compared > 500);
}

}  // namespace pluvia
