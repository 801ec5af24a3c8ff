#include "scenes/surfaces.h"

#include "renderer/core/parallel.h"
#include "renderer/image/color.h"

#include <algorithm>
#include <cmath>

namespace pluvia {
namespace {

Rgba8 coded(Rgb albedo, float alpha) {
    const auto byte = [](float linear) { return byte_from_display(srgb_from_linear(linear)); };
    return {byte(albedo.r), byte(albedo.g), byte(albedo.b), byte_from_display(alpha)};
}

/// Slopes by central differences of neighbours that wrap around.
Image<Rgba8> normals_from_heights(const Image<float>& heights, Vec2 size) {
    const int w = heights.width, h = heights.height;
    const float per_metre_x = float(w) / (2 * size.x), per_metre_y = float(h) / (2 * size.y);
    Image<Rgba8> normals(w, h);
    parallel_for(h, [&](int y) {
        for (int x = 0; x < w; ++x) {
            const float dx = (heights.at((x + 1) % w, y) - heights.at((x + w - 1) % w, y)) * per_metre_x;
            const float down = (heights.at(x, (y + 1) % h) - heights.at(x, (y + h - 1) % h)) * per_metre_y;
            const Vec3 n = normalize(Vec3(-dx, down, 1));
            const auto byte = [](float v) { return byte_from_display(0.5f * v + 0.5f); };
            normals.at(x, y) = {byte(n.x), byte(n.y), byte(n.z), 255};
        }
    });
    return normals;
}

}  // namespace

SurfaceMaps paint(int width, int height, Vec2 size, const std::function<Texel(float x, float y)>& texel) {
    SurfaceMaps maps{Image<Rgba8>(width, height), Image<Rgba8>(width, height), {}};
    Image<float> heights(width, height);
    parallel_for(height, [&](int y) {
        for (int x = 0; x < width; ++x) {
            const Texel t = texel((float(x) + 0.5f) / float(width), (float(y) + 0.5f) / float(height));
            maps.base_color.at(x, y) = coded(t.albedo, t.alpha);
            // 32 steps of roughness are finer than the eye tells apart and halve the size of the picture in a file.
            const float roughness = std::round(31 * t.roughness) / 31;
            maps.metallic_roughness.at(x, y) = {255, byte_from_display(roughness), byte_from_display(t.metallic), 255};
            heights.at(x, y) = t.height;
        }
    });
    maps.normal = normals_from_heights(heights, size);
    return maps;
}

Image<Rgba8> paint_color(int width, int height, const std::function<Rgb(float x, float y)>& color) {
    Image<Rgba8> image(width, height);
    parallel_for(height, [&](int y) {
        for (int x = 0; x < width; ++x)
            image.at(x, y) = coded(color((float(x) + 0.5f) / float(width), (float(y) + 0.5f) / float(height)), 1);
    });
    return image;
}

}  // namespace pluvia
