#include "tools/dataset/thumbnail.h"

#include <algorithm>

namespace pluvia {

Image<Rgba8> shrunk(const Image<Rgba8>& image, int most_width) {
    if (image.width <= most_width) return image;
    const int width = most_width, height = std::max(1, int(int64_t(image.height) * most_width / image.width));
    Image<Rgba8> result(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const int x0 = int(int64_t(x) * image.width / width), x1 = int(int64_t(x + 1) * image.width / width);
            const int y0 = int(int64_t(y) * image.height / height), y1 = int(int64_t(y + 1) * image.height / height);
            unsigned r = 0, g = 0, b = 0, n = 0;
            for (int v = y0; v < std::max(y1, y0 + 1); ++v)
                for (int u = x0; u < std::max(x1, x0 + 1); ++u, ++n) {
                    const Rgba8 p = image.at(u, v);
                    r += p.r, g += p.g, b += p.b;
                }
            result.at(x, y) = {uint8_t((r + n / 2) / n), uint8_t((g + n / 2) / n), uint8_t((b + n / 2) / n)};
        }
    return result;
}

}  // namespace pluvia
