#include "renderer/scene/texture.h"

#include "renderer/image/color.h"

#include <cmath>

namespace pluvia {
namespace {

/// i: at most one texel outside of what reduce() leaves, so that no division is needed.
int wrap_index(int i, int size, Wrap wrap) {
    switch (wrap) {
        case Wrap::clamp:
            return std::clamp(i, 0, size - 1);
        case Wrap::mirror:
            if (i < 0) return 0;
            if (i >= 2 * size) return std::min(i - 2 * size, size - 1);
            return i < size ? i : 2 * size - 1 - i;
        default:
            return i < 0 ? i + size : i >= size ? i - size : i;
    }
}

/// Mirrored coordinates to 0..2, repeated ones to 0..1, clamped ones near 0..1; what is not a number becomes 0.
float reduce(float x, Wrap wrap) {
    const float reduced = wrap == Wrap::clamp    ? std::clamp(x, -1.0f, 2.0f)
                          : wrap == Wrap::mirror ? x - 2 * std::floor(x / 2)
                                                 : x - std::floor(x);
    return reduced >= -1 ? reduced : 0;
}

struct Texels {
    const Rgba8* corner[4];
    float weight[4];
};

Texels find_texels(const Scene& scene, const Texture& texture, Vec2 uv) {
    const Image<Rgba8>& image = scene.images[texture.image];
    const float x = reduce(uv.x, texture.wrap_u) * float(image.width);
    const float y = reduce(uv.y, texture.wrap_v) * float(image.height);
    const auto texel = [&](int i, int j) {
        return &image.pixels[size_t(wrap_index(j, image.height, texture.wrap_v)) * image.width +
                             wrap_index(i, image.width, texture.wrap_u)];
    };
    if (texture.nearest) {
        const Rgba8* t = texel(int(std::floor(x)), int(std::floor(y)));
        return {{t, t, t, t}, {1, 0, 0, 0}};
    }
    const float fx = std::floor(x - 0.5f), fy = std::floor(y - 0.5f);
    const float tx = x - 0.5f - fx, ty = y - 0.5f - fy;
    const int i = int(fx), j = int(fy);
    return {{texel(i, j), texel(i + 1, j), texel(i, j + 1), texel(i + 1, j + 1)},
            {(1 - tx) * (1 - ty), tx * (1 - ty), (1 - tx) * ty, tx * ty}};
}

}  // namespace

Rgb lookup_color(const Scene& scene, int texture, Vec2 uv) {
    const Texels t = find_texels(scene, scene.textures[texture], uv);
    const auto& linear = linear_from_srgb8();
    Rgb sum;
    for (int k = 0; k < 4; ++k)
        sum += t.weight[k] * Rgb(linear[t.corner[k]->r], linear[t.corner[k]->g], linear[t.corner[k]->b]);
    return sum;
}

Vec3 lookup_linear(const Scene& scene, int texture, Vec2 uv) {
    const Texels t = find_texels(scene, scene.textures[texture], uv);
    Vec3 sum;
    for (int k = 0; k < 4; ++k)
        sum += t.weight[k] * Vec3(float(t.corner[k]->r), float(t.corner[k]->g), float(t.corner[k]->b));
    return sum / 255.0f;
}

void prefetch_texels(const Scene& scene, int texture, Vec2 uv) {
    const Texels t = find_texels(scene, scene.textures[texture], uv);
    // The left texels and the right ones are mostly in the same line of the cache.
    __builtin_prefetch(t.corner[0]);
    __builtin_prefetch(t.corner[2]);
}

float lookup_alpha(const Scene& scene, int texture, Vec2 uv) {
    const Texels t = find_texels(scene, scene.textures[texture], uv);
    float sum = 0;
    for (int k = 0; k < 4; ++k) sum += t.weight[k] * float(t.corner[k]->a);
    return sum / 255.0f;
}

}  // namespace pluvia
