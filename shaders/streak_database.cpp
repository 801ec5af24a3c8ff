#include "shaders/streak_database.h"

#include "renderer/core/units.h"

#include <algorithm>
#include <cmath>

namespace pluvia {
namespace {

constexpr int azimuth_count = int(streak_azimuths.size());
constexpr float degrees = 180 / pi;

}  // namespace

Vec3 StreakLight::direction() const {
    const float e = float(streak_elevations[size_t(elevation)]) / degrees;
    const float a = float(streak_azimuths[size_t(azimuth)]) / degrees;
    const float level = on_axis() ? 0 : std::cos(e);
    return {level * std::sin(a), std::sin(e), level * std::cos(a)};
}

StreakLight streak_light(int index) {
    if (index == 0) return {0, azimuth_count - 1};
    if (index == streak_light_count - 1) return {int(streak_elevations.size()) - 1, azimuth_count - 1};
    return {1 + (index - 1) / azimuth_count, (index - 1) % azimuth_count};
}

int nearest_streak_light(Vec3 direction, bool* mirrored) {
    if (mirrored) *mirrored = direction.x < 0;
    const float elevation = std::asin(std::clamp(direction.y, -1.0f, 1.0f)) * degrees;
    const int row = std::clamp(int(std::floor((elevation + 100) / 20)), 0, int(streak_elevations.size()) - 1);
    if (row == 0) return 0;
    if (row == int(streak_elevations.size()) - 1) return streak_light_count - 1;
    const float azimuth = std::atan2(std::abs(direction.x), direction.z) * degrees;
    return 1 + (row - 1) * azimuth_count + std::clamp(int(azimuth / 20), 0, azimuth_count - 1);
}

int nearest_streak_view(float elevation) {
    return std::min(int(std::abs(elevation) * degrees / 20 + 0.5f), int(streak_views.size()) - 1);
}

StreakPicture picture_from(const std::vector<float>& values) {
    StreakPicture picture;
    picture.factor = *std::max_element(values.begin(), values.end());
    const float scale = picture.factor > 0 ? 65535 / picture.factor : 0;
    picture.values.reserve(values.size());
    for (const float v : values) picture.values.push_back(uint16_t(std::lround(std::clamp(v * scale, 0.0f, 65535.0f))));
    return picture;
}

static StreakPicture narrowed(const StreakPicture& picture, int width, int height, int n) {
    StreakPicture result{{}, picture.factor};
    const int rows = (height + n - 1) / n, block = n * n;
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < width / n; ++x) {
            int sum = 0;
            for (int row = y * n; row < std::min((y + 1) * n, height); ++row)
                for (int column = x * n; column < (x + 1) * n; ++column)
                    sum += picture.values[size_t(row) * width + column];
            result.values.push_back(uint16_t((sum + block / 2) / block));
        }
    return result;
}

StreakDatabase narrowed(const StreakDatabase& database, int n) {
    StreakDatabase result;
    for (size_t v = 0; v < streak_views.size(); ++v) {
        const StreakDatabase::View& from = database.views[v];
        StreakDatabase::View& to = result.views[v];
        to.width = from.width / n, to.height = (from.height + n - 1) / n;
        for (const StreakPicture& picture : from.pictures)
            to.pictures.push_back(narrowed(picture, from.width, from.height, n));
        for (size_t i = 0; i < from.ambient.size(); ++i)
            to.ambient[i] = narrowed(from.ambient[i], from.width, from.height, n);
    }
    return result;
}

}  // namespace pluvia
