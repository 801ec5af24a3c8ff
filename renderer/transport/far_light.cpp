#include "renderer/transport/far_light.h"

#include "renderer/core/parallel.h"
#include "shaders/environment.h"
#include "shaders/raindrop.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace pluvia {
namespace {

// The phase function falls to a half within 20 degrees and is smooth but for the rainbow, of 1 % of the light.
constexpr int table_width = 64, table_height = 32, source_width = 128, source_height = 64;
constexpr int points = 4;  // across a source: the sun of a picture of the sky is smaller than a source

Image<Rgb> cell_means(const std::function<Rgb(Vec3)>& radiance) {
    Image<Rgb> cells(source_width, source_height);
    parallel_for(source_height, [&](int y) {
        for (int x = 0; x < source_width; ++x) {
            Rgb sum;
            for (int j = 0; j < points; ++j)
                for (int i = 0; i < points; ++i)
                    sum += radiance(direction_from_equirectangular((x + (i + 0.5) / points) / source_width,
                                                                   (y + (j + 0.5) / points) / source_height));
            cells.at(x, y) = sum / float(points * points);
        }
    });
    return cells;
}

}  // namespace

FarLight::FarLight(const std::function<Rgb(Vec3)>& radiance, const std::function<Rgb(Vec3)>& open)
    : radiance_(cell_means(radiance)), open_(cell_means(open)), table_(table_width, table_height) {
    struct Source {
        Vec3 direction;
        Rgb radiance;
        float size;  // of its solid angle, but for a factor
    };
    std::vector<Source> sources;
    for (int y = 0; y < source_height; ++y)
        for (int x = 0; x < source_width; ++x) {
            const Vec3 d = direction_from_equirectangular((x + 0.5) / source_width, (y + 0.5) / source_height);
            sources.push_back({d, radiance_.at(x, y), std::sqrt(std::max(0.0f, 1 - d.y * d.y))});
        }
    parallel_for(table_height, [&](int y) {
        for (int x = 0; x < table_width; ++x) {
            const Vec3 towards = direction_from_equirectangular((x + 0.5) / table_width, (y + 0.5) / table_height);
            std::array<double, 3> sum = {};
            double weights = 0;
            for (const Source& source : sources) {
                const double weight = double(drop_phase(dot(source.direction, towards)) * source.size);
                sum[0] += weight * source.radiance.r, sum[1] += weight * source.radiance.g;
                sum[2] += weight * source.radiance.b;
                weights += weight;
            }
            table_.at(x, y) = Rgb(float(sum[0] / weights), float(sum[1] / weights), float(sum[2] / weights));
        }
    });
}

Rgb FarLight::of_drop(Vec3 direction) const {
    const Vec2 uv = equirectangular_from_direction(direction);
    const float x = uv.x * table_width - 0.5f, y = std::clamp(uv.y * table_height - 0.5f, 0.0f, table_height - 1.0f);
    const int x0 = int(std::floor(x)), y0 = std::min(int(y), table_height - 2);
    const float s = x - float(x0), t = y - float(y0);
    const int left = (x0 + table_width) % table_width, right = (left + 1) % table_width;
    return mix(mix(table_.at(left, y0), table_.at(right, y0), s),
               mix(table_.at(left, y0 + 1), table_.at(right, y0 + 1), s), t);
}

Rgb FarLight::cell(const Image<Rgb>& cells, Vec3 direction) {
    const Vec2 uv = equirectangular_from_direction(direction);
    return cells.at(std::clamp(int(uv.x * source_width), 0, source_width - 1),
                    std::clamp(int(uv.y * source_height), 0, source_height - 1));
}

}  // namespace pluvia
