// Scenes of millimetres and kilometres, cameras close by and a thousand kilometres away, streets a thousand kilometres
// from the zero of their coordinates: the light is the same.
#include "tools/validate/extremes.h"
#include "tools/validate/known_scenes.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace pluvia {
namespace {

constexpr double lamp_light = 0.5 / std::numbers::pi * 80 / 4;  // of ground of albedo 1/2, 2 m under 80 cd

void resize(Scene& scene, double factor) {
    for (Mesh& mesh : scene.meshes)
        for (Vec3& p : mesh.positions) p = p * float(factor);
    for (PunctualLight& light : scene.lights) {
        light.position = light.position * factor;
        light.intensity *= float(factor * factor);
    }
}

Scene lit_court() {
    Scene scene = make_court(lambert(Rgb(0.5f)));
    scene.lights = {{.name = "lamp", .intensity = Rgb(500), .position = {2, 4, -1}}};
    Material lamp = emitter(Rgb(20));
    lamp.double_sided = true;
    add_quad(scene, {-4, 4, 0}, {1, 0, 0}, {0, 0, 1}, lamp);
    return scene;
}

double light_of(const Scene& scene, const View& view, int samples) {
    return sound_mean(render_picture(scene, Environment::uniform(Rgb(1)), view, {.samples = samples}), "background.G");
}

}  // namespace

std::vector<ExtremeResult> measure_scale_extremes(bool full) {
    std::vector<ExtremeResult> results;
    const int samples = full ? 256 : 64;
    const View view = court_view(32, 16);
    const double court = light_of(lit_court(), view, samples);
    for (const double factor : {1e-3, 1e3}) {  // the court is 12 m wide
        Scene scene = lit_court();
        resize(scene, factor);
        View small = view;
        small.position = view.position * factor;
        // 1e-3: the same paths but for those that rounding sends past an edge.
        results.push_back(relative_result(fmt::format("court {:g} m wide, over that of 12 m", 12 * factor), 1,
                                          light_of(scene, small, samples) / court, 1e-3));
    }
    for (const Vec3d offset : {Vec3d(1e6, 0, 0), Vec3d(-1e6, 1e6, 1e6)}) {
        Scene scene = lit_court();
        for (Instance& instance : scene.instances) instance.scene_from_object.translation = offset;
        for (PunctualLight& light : scene.lights) light.position = light.position + offset;
        rebase(scene);
        View moved = view;
        moved.position = view.position + offset - scene.origin;
        results.push_back(relative_result(
            fmt::format("court moved by {:g}, {:g}, {:g} m, over that at 0", offset.x, offset.y, offset.z), 1,
            light_of(scene, moved, samples) / court, 1e-3));
    }

    Scene ground = make_plane(lambert(Rgb(0.5f)));
    ground.lights = {{.name = "lamp", .intensity = Rgb(80), .position = {0, 2, 0}}};
    for (const double distance : {1e-4, 1e-2, 1.0, 1e2, 1e4, 1e6}) {
        const View from =
            look_at(normalize(Vec3d(4, 1.5, 3)) * distance, {0, 0, 0}, 4, 4, 1e3 * std::max(1.0, distance));
        results.push_back(relative_result(
            fmt::format("ground under a lamp, seen from {:g} m: albedo I / (pi h^2)", distance), lamp_light,
            sound_mean(render_picture(ground, Environment(), from, {.samples = 4}), "background.G"),
            // A pixel is up to 1 mm wide there, the point seen up to 4 mm from the foot.
            2e-5));
        if (distance < 1) continue;
        // Seen slantwise, so that no coordinate of the ray is a round number; the card faces the camera.
        const Vec3d middle(3.3, 1.7, -2.1);
        const View towards = look_at(middle + normalize(Vec3d(0.6, 0.3, 1)) * distance, middle, 32, 32, 160 * distance);
        Scene card;
        add_quad(card, Vec3(middle - (towards.right + towards.up) * 0.05), Vec3(towards.right * 0.1),
                 Vec3(towards.up * 0.1), emitter(Rgb(1)));
        // A small part far away, so that the card is not all that there is.
        add_quad(card, {-5, -5, -5}, {0.1f, 0, 0}, {0, 0, 0.1f}, lambert(Rgb(0)));
        const Picture picture = render_picture(card, Environment(), towards, {.samples = 64});
        results.push_back(
            relative_result(fmt::format("share of the picture that a card of 10 cm fills from {:g} m", distance), 0.25,
                            sound_mean(picture, "background.G"), 1e-3));
        // The card's middle is known to 1e-7 of the scene, and depth is stored in single precision.
        results.push_back(relative_result(fmt::format("its depth from {:g} m", distance), distance,
                                          picture.plane("Z")[16 * 32 + 16], 3e-7));
    }
    // A slope of many kilometres under a lamp: the corners are far away, and what is seen is not.
    for (const double size : {100.0, 1e3, 1e4, 1e5}) {
        const Vec3d up = normalize(Vec3d(0.3, 1, 0.2)), side = normalize(cross(up, Vec3d(1, 0, 0.4))),
                    along = cross(side, up);
        Scene slope;
        add_quad(slope, Vec3((side + along) * (-size * 0.4)), Vec3(along * size), Vec3(side * size),
                 lambert(Rgb(0.5f)));
        slope.lights = {{.name = "lamp", .intensity = Rgb(80), .position = up * 2}};
        results.push_back(relative_result(
            fmt::format("slope of {:g} m under a lamp: albedo I / (pi h^2)", size), lamp_light,
            sound_mean(
                render_picture(slope, Environment(), look_at(up * 3 + side * 4, {0, 0, 0}, 4, 4, 1e4), {.samples = 64}),
                "background.G"),
            1e-3));
    }
    return results;
}

}  // namespace pluvia
