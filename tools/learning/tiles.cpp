#include "tools/learning/tiles.h"

#include "renderer/core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pluvia {
namespace {

constexpr float least_weight = 1e-4f;  // so that no place is without

int round_up(int value, int unit) {
    return (value + unit - 1) / unit * unit;
}

}  // namespace

TileAxis tile_axis(int length, int cell, int unit, const TileSettings& s) {
    if (s.size < unit || s.size % unit != 0 || s.size > 8192)
        throw usage_error("--tile",
                          fmt::format("is not valid (got {}, expected a multiple of {} up to 8192)", s.size, unit));
    if (!s.plain && (s.overlap < 0 || s.overlap > s.size / 2))
        throw usage_error("--overlap", fmt::format("is not valid (got {}, expected 0 to half of the tile, {})",
                                                   s.overlap, s.size / 2));
    TileAxis axis;
    if (!s.plain) {
        axis.margin = s.overlap / 4 / cell * cell;
        axis.ramp = s.overlap / 2;
    }
    axis.before = axis.margin + s.shift / cell * cell;
    const int need = axis.before + length + axis.margin;
    axis.size = s.plain ? s.size : std::min(s.size, round_up(need, unit));
    if (s.plain || need <= axis.size) {
        const int count = (need + axis.size - 1) / axis.size;
        for (int i = 0; i < count; ++i) axis.positions.push_back(i * axis.size);
    } else {
        // As many as the least overlap asks for, spread evenly.
        const int spread = round_up(need - axis.size, cell), step = axis.size - s.overlap;
        const int last = (spread + step - 1) / step;
        for (int i = 0; i <= last; ++i) axis.positions.push_back(int(int64_t(spread) * i / last) / cell * cell);
    }
    axis.padded = axis.positions.back() + axis.size;
    return axis;
}

std::vector<float> TileAxis::weights(int cell) const {
    std::vector<float> w(size_t(size / cell), 1.0f);
    if (ramp == 0) return w;
    for (size_t i = 0; i < w.size(); ++i) {
        const double centre = (double(i) + 0.5) * cell, distance = std::min(centre, size - centre);
        const double position = std::clamp((distance - margin) / ramp, 0.0, 1.0);
        const double sine = std::sin(position * std::numbers::pi / 2);
        w[i] = std::max(least_weight, float(sine * sine));
    }
    return w;
}

TilePlan plan_tiles(int width, int height, int cell, int unit, const TileSettings& settings) {
    return {tile_axis(width, cell, unit, settings), tile_axis(height, cell, unit, settings), settings.plain};
}

int reflected(int position, int length) {
    if (length == 1) return 0;
    const int period = 2 * (length - 1);
    const int p = ((position % period) + period) % period;
    return p < length ? p : period - p;
}

}  // namespace pluvia
