// Lenses at their ends: how large things are in the picture, what is sharp, and that blur loses no light.
#include "renderer/scene/camera.h"
#include "tools/validate/extremes.h"
#include "tools/validate/known_scenes.h"
#include "tools/validate/running_mean.h"

#include <fmt/format.h>

#include <cmath>

namespace pluvia {
namespace {

View lens(double focal_length_mm, double f_number, double focus) {
    CameraSettings settings{.width = 72, .height = 36};
    settings.focal_length = metres_from_mm(focal_length_mm);
    settings.f_number = f_number, settings.focus_distance = focus;
    return make_view(Camera(), settings);
}

/// Shines from x = left to right, y = -height to height, at a depth in front of a camera in the origin.
Scene card(double left, double right, double height, double depth) {
    Scene scene;
    add_quad(scene, {float(left), float(-height), float(-depth)}, {float(right - left), 0, 0},
             {0, float(2 * height), 0}, emitter(Rgb(1)));
    return scene;
}

}  // namespace

std::vector<ExtremeResult> measure_camera_extremes(bool full) {
    std::vector<ExtremeResult> results;
    for (const double mm : {4.0, 800.0}) {
        const View view = lens(mm, 0, 10);
        // 16 x 8 pixels, whose borders are the card's.
        const double half = 8 / view.focal_pixels;
        results.push_back(relative_result(
            fmt::format("share of the picture that a card of {:.3g} m fills, 1 m away, lens of {} mm", 2 * half, mm),
            16.0 * 8 / (72 * 36),
            sound_mean(render_picture(card(-half, half, half / 2, 1), Environment(), view, {.samples = 64}),
                       "background.G"),
            1e-5));
        for (const double f_number : {0.7, 64.0}) {
            // Four times as near as the focus, far enough from the borders that all light stays in the picture.
            const double focus = std::max(4.0, mm / 800 * 4000), depth = mm < 800 ? focus / 4 : 0.99 * focus;
            const View open = lens(mm, f_number, focus);
            const double size = 4 / open.focal_pixels * depth;
            const Scene scene = card(-size, size, size, depth);
            results.push_back(mean_result(
                fmt::format("light of a card out of focus, blurred by {:.2g} pixels, {} mm, f/{}",
                            2 * open.blur_radius_pixels(depth), mm, f_number),
                8.0 * 8 / (72 * 36),
                sound_means(scene, Environment(), open, {.samples = 256}, "background.G", full ? 32 : 4), 1e-5));
        }
    }
    // A lens of 51 mm opening that looks at 5 cm: the card's edge is a hundredth of a pixel left of the 37th column.
    const View close = lens(36, 0.7, 0.05);
    const Picture edge =
        render_picture(card(-1, -0.01 / close.focal_pixels * 0.05, 1, 0.05), Environment(), close, {.samples = 64});
    double left = 0, right = 0;
    for (int y = 0; y < edge.height; ++y) {
        left += edge.plane("background.G")[size_t(y) * 72 + 35] / edge.height;
        right += edge.plane("background.G")[size_t(y) * 72 + 36] / edge.height;
    }
    // Without focus the light would go over 37 pixels. 0.01: one sample in 64 is in that hundredth of a pixel or is
    // not.
    results.push_back({"f/0.7 of 36 mm, focus at 5 cm: pixel at the inside of an edge", 0.99, left, 0.01});
    results.push_back({"f/0.7 of 36 mm, focus at 5 cm: pixel at its outside", 0, right, 0});
    return results;
}

}  // namespace pluvia
