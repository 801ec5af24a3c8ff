#include "renderer/scene/texture_size.h"

#include "renderer/core/parallel.h"
#include "renderer/image/color.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pluvia {
namespace {

/// Which of the scene's pictures a slot reads as colour.
std::vector<bool> colors_of(const Scene& scene) {
    std::vector<bool> is_color(scene.images.size());
    for (const Material& material : scene.materials)
        for (const TextureSlot* slot : {&material.base_color_texture, &material.emission_texture,
                                        &material.specular_color_texture, &material.sheen_color_texture})
            if (slot->used()) is_color[size_t(scene.textures[size_t(slot->texture)].image)] = true;
    return is_color;
}

/// The texels that one of the smaller row or column covers, with their shares.
struct Cover {
    int begin, end;
    double first, last;  // shares of the outermost two; those between count whole

    double share(int i) const { return i == begin ? first : i == end - 1 ? last : 1.0; }
};

Cover cover_of(int i, int small, int large) {
    const double scale = double(large) / small, from = i * scale, to = std::min((i + 1) * scale, double(large));
    const int begin = int(from), end = std::max(begin + 1, int(std::ceil(to)));
    if (end - begin == 1) return {begin, end, to - from, to - from};
    return {begin, end, begin + 1 - from, to - (end - 1)};
}

Rgba8 mean_of(const Image<Rgba8>& image, const Cover& columns, const Cover& rows, bool is_color) {
    const std::array<float, 256>& light = linear_from_srgb8();
    std::array<double, 3> sum = {};
    double alpha = 0, area = 0, weights = 0;
    for (int y = rows.begin; y < rows.end; ++y)
        for (int x = columns.begin; x < columns.end; ++x) {
            const Rgba8 p = image.at(x, y);
            const double share = columns.share(x) * rows.share(y);
            const double weight = is_color ? share * std::max<double>(p.a, 1) : share;
            const std::array<uint8_t, 3> stored = {p.r, p.g, p.b};
            for (size_t c = 0; c < 3; ++c) sum[c] += weight * (is_color ? double(light[stored[c]]) : stored[c]);
            weights += weight, alpha += share * p.a, area += share;
        }
    const auto stored = [&](double value) {
        const double mean = value / weights;
        return uint8_t(std::lround(is_color ? 255 * srgb_from_linear(float(mean)) : mean));
    };
    return {stored(sum[0]), stored(sum[1]), stored(sum[2]), uint8_t(std::lround(alpha / area))};
}

Image<Rgba8> shrunk(const Image<Rgba8>& image, int largest, bool is_color) {
    int width = image.width, height = image.height;
    while (std::max(width, height) > largest) width = (width + 1) / 2, height = (height + 1) / 2;
    Image<Rgba8> small(width, height);
    parallel_for(height, [&](int y) {
        const Cover rows = cover_of(y, height, image.height);
        for (int x = 0; x < width; ++x)
            small.at(x, y) = mean_of(image, cover_of(x, width, image.width), rows, is_color);
    });
    return small;
}

}  // namespace

void shrink_textures(Scene& scene, int largest) {
    const std::vector<bool> is_color = colors_of(scene);
    for (size_t i = 0; i < scene.images.size(); ++i)
        if (std::max(scene.images[i].width, scene.images[i].height) > largest)
            scene.images[i] = shrunk(scene.images[i], largest, is_color[i]);
}

}  // namespace pluvia
