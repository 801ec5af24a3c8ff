#include "renderer/image/depth_encoding.h"

#include "renderer/core/error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pluvia {
namespace {

constexpr float none = std::numeric_limits<float>::infinity();

/// Whether a depth can be told from none; false for NaN.
bool is_depth(float metres, float limit) {
    return metres > 0 && metres <= limit;
}

/// Nearest of the codes first to last; steps in double, since 24 bits and their rounding do not fit in float.
uint32_t nearest_code(float metres, double steps_per_metre, uint32_t first, uint32_t last) {
    return std::clamp(uint32_t(std::lround(double(metres) * steps_per_metre)), first, last);
}

constexpr double kitti16_steps = 256, mm16_steps = 1000;
constexpr uint32_t carla24_none = (1u << 24) - 1;
constexpr double carla24_steps = carla24_none / 1000.0;

}  // namespace

const std::vector<std::string>& depth_encoding_names() {
    static const std::vector<std::string> names = {"kitti16", "mm16", "carla24", "hri"};
    return names;
}

DepthEncoding depth_encoding_from_name(const std::string& name, const std::string& where) {
    const auto& names = depth_encoding_names();
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) {
        std::string list;
        for (const std::string& known : names) list += (list.empty() ? "" : ", ") + known;
        throw usage_error(where, "unknown depth encoding (got " + name + ", expected one of " + list + ")");
    }
    return DepthEncoding(found - names.begin());
}

uint16_t encode_kitti16(float metres) {
    return is_depth(metres, kitti16_limit) ? uint16_t(nearest_code(metres, kitti16_steps, 1, 65535)) : 0;
}
float decode_kitti16(uint16_t value) {
    return value == 0 ? none : float(value / kitti16_steps);
}

uint16_t encode_mm16(float metres) {
    return is_depth(metres, mm16_limit) ? uint16_t(nearest_code(metres, mm16_steps, 1, 65535)) : 0;
}
float decode_mm16(uint16_t value) {
    return value == 0 ? none : float(value / mm16_steps);
}

Rgba8 encode_carla24(float metres) {
    const uint32_t code =
        is_depth(metres, carla24_limit) ? nearest_code(metres, carla24_steps, 0, carla24_none - 1) : carla24_none;
    return {uint8_t(code), uint8_t(code >> 8), uint8_t(code >> 16), 255};
}
float decode_carla24(Rgba8 value) {
    const uint32_t code = value.r | uint32_t(value.g) << 8 | uint32_t(value.b) << 16;
    return code == carla24_none ? none : float(code / carla24_steps);
}

float decode_carla_log(uint8_t value) {
    return value == 255 ? none : float(1000 * std::exp(5.70378 * (value / 255.0 - 1)));
}

uint16_t encode_hri(float metres, float depth_max) {
    return is_depth(metres, depth_max) ? uint16_t(nearest_code(metres, 65535 / double(depth_max), 0, 65534)) : 65535;
}
float decode_hri(uint16_t value, float depth_max) {
    return value == 65535 ? none : float(value / 65535.0 * double(depth_max));
}

int64_t count_beyond(std::span<const float> metres, float limit) {
    return std::ranges::count_if(metres, [&](float depth) { return std::isfinite(depth) && depth > limit; });
}

}  // namespace pluvia
