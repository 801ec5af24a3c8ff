// Surfaces at the ends of their parameters, in an even world or in a closed room.
#include "tools/validate/extremes.h"
#include "tools/validate/known_scenes.h"
#include "tools/validate/running_mean.h"

#include <fmt/format.h>

#include <cmath>

namespace pluvia {
namespace {

int add_texture(Scene& scene, Image<Rgba8> image) {
    scene.images.push_back(std::move(image));
    scene.textures.push_back({.image = int(scene.images.size()) - 1});
    return int(scene.textures.size()) - 1;
}

/// A closed room around a camera whose walls all shine.
Scene room(float albedo) {
    Scene scene;
    Material wall = lambert(Rgb(albedo));
    wall.emission = Rgb(1), wall.double_sided = true;
    add_box(scene, {-2, -2, -2}, {2, 2, 2}, wall);
    return scene;
}

}  // namespace

std::vector<ExtremeResult> measure_material_extremes(bool full) {
    std::vector<ExtremeResult> results;
    const Environment world = Environment::uniform(Rgb(1));
    const View view = court_view(24, 12);
    const int seeds = full ? 32 : 4;
    const auto furnace = [&](const std::string& name, const Material& material, double expected, double tolerance) {
        results.push_back(mean_result(
            "court in an even world, " + name, expected,
            sound_means(make_court(material), world, view, {.samples = 64}, "background.G", seeds), tolerance));
    };
    const double rounding = 1e-5, tables = 1e-3;  // of sums; of the tables of multiple scattering
    Material m = lambert(Rgb(1));
    for (const float roughness : {0.0f, 1.0f}) {
        m.metallic = 1, m.specular = 1, m.roughness = roughness;
        furnace(fmt::format("metal of roughness {}", roughness), m, 1, tables);
        m.metallic = 0;
        furnace(fmt::format("white plastic of roughness {}", roughness), m, 1, tables);
        m.clearcoat = 1, m.clearcoat_roughness = roughness;
        furnace(fmt::format("plastic and coat of roughness {}", roughness), m, 1, tables);
        m.clearcoat = 0;
    }
    m = lambert(Rgb(1));
    m.specular = 1, m.ior = 1, m.roughness = 0.5f;
    furnace("plastic of index 1", m, 1, rounding);
    Material pane = lambert(Rgb(1));
    pane.transmission = 1, pane.ior = 1, pane.roughness = 0;
    furnace("panes of index 1", pane, 1, rounding);
    {
        // A body of glass in one of water, both in front of the sky.
        Material water = lambert(Rgb(1)), glass = lambert(Rgb(1));
        water.transmission = glass.transmission = 1, water.roughness = glass.roughness = 0;
        water.ior = 1.333f, glass.ior = 1.5f, water.thickness = glass.thickness = 1;
        Scene scene;
        add_sphere(scene, {0, 0, 0}, 1, 64, water);
        add_sphere(scene, {0, 0, 0}, 0.6f, 64, glass);
        results.push_back(mean_result("ball of glass in a ball of water in an even world", 1,
                                      sound_means(scene, world, look_at({0, 0, 3}, {0, 0, 0}, 24, 24, 30),
                                                  {.samples = 64}, "background.G", seeds),
                                      rounding));
    }
    // What paths in a closed room gather is a geometric series.
    const View inside = look_at({0.5, 0.2, 0.3}, {0, 0, -1}, 8, 8, 8);
    const int pictures = full ? 32 : 12;  // few give no standard error to judge by: of 4 it is a third off
    for (const auto& [albedo, bounces, samples] :
         {std::tuple{0.0f, -1, 4}, {0.5f, -1, 256}, {0.99f, -1, 64}, {1.0f, 1000, 16}}) {
        RenderSettings settings{.samples = samples};
        if (bounces >= 0) settings.path.max_bounces = bounces;
        const double expected = albedo == 1 ? bounces + 1 : 1 / (1 - double(albedo));
        results.push_back(
            mean_result(fmt::format("closed room, every wall shines, albedo {}{}", albedo,
                                    bounces < 0 ? "" : fmt::format(", {} bounces", bounces)),
                        expected, sound_means(room(albedo), Environment(), inside, settings, "background.G", pictures),
                        rounding * expected));
    }
    // Textures. 186 of 255 is 0.4910 in linear light.
    const double linear = std::pow((186 / 255.0 + 0.055) / 1.055, 2.4);
    std::vector<std::pair<int, int>> sizes = {{1, 1}, {16384, 1}};
    if (full) sizes.push_back({16384, 16384});
    for (const auto& [width, height] : sizes) {
        Scene scene;
        const int texture = add_texture(scene, Image<Rgba8>(width, height, Rgba8{186, 186, 186, 255}));
        Material paper = emitter(Rgb(1));
        paper.emission_texture = texture;
        add_quad(scene, {-50, 0, 50}, {100, 0, 0}, {0, 0, -100}, paper);
        results.push_back(mean_result(
            fmt::format("plane that shines, with a texture of {} x {} of value 186", width, height), linear,
            sound_means(scene, world, look_at({4, 1.5, 3}, {0, 0, 0}, 4, 4, 8), {.samples = 16}, "background.G", 4),
            1e-5));
    }
    {
        // A normal that points into the surface: what it reflects is no more than what arrives.
        Scene scene;
        const int texture = add_texture(scene, Image<Rgba8>(1, 1, Rgba8{160, 90, 0, 255}));
        Material bent = lambert(Rgb(1));
        bent.normal_texture = texture;
        add_quad(scene, {-50, 0, 50}, {100, 0, 0}, {0, 0, -100}, bent);
        const double mean =
            sound_means(scene, world, look_at({4, 1.5, 3}, {0, 0, 0}, 8, 8, 8), {.samples = 256}, "background.G", 4)
                .mean();
        results.push_back(
            {"normal map pointing backwards: light beyond what arrives", 0, mean - std::min(mean, 1.0), 1e-3});
        results.push_back({"normal map pointing backwards: half of what arrives is missing at most", 0,
                           std::max(0.0, 0.5 - mean), 0});
    }
    return results;
}

}  // namespace pluvia
