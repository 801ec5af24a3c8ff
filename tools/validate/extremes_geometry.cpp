// Meshes as files have them at their worst, and those with nearly nothing in them.
#include "tools/validate/extremes.h"
#include "tools/validate/known_scenes.h"
#include "tools/validate/running_mean.h"

#include <cmath>
#include <numbers>

namespace pluvia {
namespace {

/// Triangles without area: a point, a line, a line on an edge of the first triangle.
void add_degenerate(Mesh& mesh) {
    const uint32_t n = uint32_t(mesh.positions.size());
    for (const Vec3 p : {Vec3(0.5f, 1, 0.5f), Vec3(1.5f, 1, 0.5f), Vec3(2.5f, 1, 0.5f)}) {
        mesh.positions.push_back(p);
        if (!mesh.uvs.empty()) mesh.uvs.push_back({0, 0});
    }
    mesh.triangles.push_back({n, n, n});
    mesh.triangles.push_back({n, n + 1, n + 2});
    mesh.triangles.push_back({n, n + 1, n});
    mesh.triangles.push_back({0, 1, 0});
}

/// Every triangle with vertices of its own.
void separate(Mesh& mesh) {
    Mesh result = mesh;
    result.positions.clear(), result.uvs.clear(), result.triangles.clear();
    for (const auto& triangle : mesh.triangles) {
        const uint32_t n = uint32_t(result.positions.size());
        for (const uint32_t corner : triangle) {
            result.positions.push_back(mesh.positions[corner]);
            if (!mesh.uvs.empty()) result.uvs.push_back(mesh.uvs[corner]);
        }
        result.triangles.push_back({n, n + 1, n + 2});
    }
    mesh = result;
}

Scene lit_court() {
    Scene scene = make_court(lambert(Rgb(0.5f)));
    Material lamp = emitter(Rgb(20));
    lamp.double_sided = true;
    add_quad(scene, {-4, 4, 0}, {1, 0, 0}, {0, 0, 1}, lamp);
    return scene;
}

}  // namespace

std::vector<ExtremeResult> measure_geometry_extremes(bool full) {
    std::vector<ExtremeResult> results;
    const Environment world = Environment::uniform(Rgb(1));
    const View view = court_view(24, 12);
    const int seeds = full ? 32 : 8;
    const auto light = [&](const Scene& scene) {
        return sound_means(scene, world, view, {.samples = 64}, "background.G", seeds);
    };
    const RunningMean court = light(lit_court());
    const auto compare = [&](const char* name, const Scene& scene) {
        RunningMean got = light(scene);
        // The same in expectation: both are means over the seeds.
        results.push_back({name, court.mean(), got.mean(), 5 * court.standard_error() + 1e-6, got.standard_error()});
    };
    Scene scene = lit_court();
    for (Mesh& mesh : scene.meshes) add_degenerate(mesh);
    compare("court with triangles without area, lamps too", scene);
    scene = lit_court();
    for (Mesh& mesh : scene.meshes) separate(mesh);
    compare("court with every vertex doubled", scene);
    scene = lit_court();
    const size_t parts = scene.instances.size() - 1;  // all but the lamp
    for (size_t i = 0; i < parts; ++i) scene.instances.push_back(scene.instances[i]);
    compare("court with every wall twice in the same place", scene);

    // Outside is a world of 1e6 cd/m2: nothing comes through the edges of a closed box.
    Scene box;
    add_box(box, {-2, -2, -2}, {2, 2, 2}, lambert(Rgb(0.8f)));
    results.push_back(
        {"light that leaks into a closed box", 0,
         sound_mean(render_picture(box, Environment::uniform(Rgb(1e6f)),
                                   look_at({0.5, 0.2, 0.3}, {-2, -2, -2}, 32, 32, 24), {.samples = full ? 1024 : 64}),
                    "background.G"),
         0});

    // Half of a picture of 32 x 32 pixels, cut along its diagonal.
    Scene triangle;
    add_quad(triangle, {-2, -2, -1}, {4, 0, 0}, {0, 4, 0}, emitter(Rgb(1)));
    triangle.meshes[0].triangles.resize(1);
    results.push_back(mean_result("mesh of one triangle: half of the picture", 0.5,
                                  sound_means(triangle, Environment(), look_at({0, 0, 0}, {0, 0, -1}, 32, 32, 8),
                                              {.samples = 64}, "background.G", seeds)));

    RenderSettings rain{.samples = 16};
    rain.rain.intensities_mm_per_h = {100};
    const Picture nothing = render_picture(Scene(), world, view, rain);
    results.push_back({"no scene: the environment", 1, sound_mean(nothing, "background.G"), 1e-6});
    results.push_back({"no scene: share of pixels at infinity", 1,
                       double(std::count_if(nothing.plane("Z").begin(), nothing.plane("Z").end(),
                                            [](float z) { return std::isinf(z); })) /
                           double(nothing.plane("Z").size()),
                       0});
    results.push_back(mean_result("no scene, rain of 100 mm/h in an even world", 1,
                                  sound_means(Scene(), world, view, rain, "rainy_100.G", seeds), 1e-5));
    return results;
}

}  // namespace pluvia
