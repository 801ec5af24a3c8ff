// Depth as integers, one value at a time, in the encodings that datasets use.
// Exact depth is in the EXR layers Z and distance.Y (exr.h); these are for pictures that other programs read.
#pragma once

#include "renderer/image/image.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace pluvia {

/// kitti16: 16 bits, metres * 256, 0 = none. Source: KITTI depth devkit.
/// mm16: 16 bits, millimetres, 0 = none. Source: BOP challenge and RGB-D sets.
/// carla24: RGB, R + 256 G + 65536 B over 2^24 - 1 times 1000 m, all 255 = none. Source: CARLA sensor reference.
/// hri: 16 bits, value / 65535 of a depth that travels beside the picture, 65535 = none.
enum class DepthEncoding { kitti16, mm16, carla24, hri };

/// Names in the order of the enum.
const std::vector<std::string>& depth_encoding_names();
/// Throws Error (usage) with the list of names for any other. where: the option or key that was read.
DepthEncoding depth_encoding_from_name(const std::string& name, const std::string& where);

// Encoders take metres. None is what the sky (+inf), depths beyond the limit, NaN and depths of zero or less become; a
// depth too near or too far to differ from none becomes the next that does. Decoders give +inf for none.

constexpr float kitti16_limit = 65535.5f / 256;  // 255.998 m: what still rounds to the last code
constexpr float mm16_limit = 65.5355f;           // m
constexpr float carla24_limit = 1000;            // m, the far plane of CARLA's cameras

uint16_t encode_kitti16(float metres);
float decode_kitti16(uint16_t value);

uint16_t encode_mm16(float metres);
float decode_mm16(uint16_t value);

/// Opaque; g and b hold the higher bytes.
Rgba8 encode_carla24(float metres);
float decode_carla24(Rgba8 value);

/// Of CARLA's logarithmic depth picture, 8 bits: 1000 m * exp(5.70378 (value / 255 - 1)), steps of 2.3 %. Nothing is
/// nearer than 3.4 m there, and 255 is none. Source: CARLA, LibCarla/source/carla/image/ColorConverter.h,
/// LogarithmicLinear, solved for the depth.
float decode_carla_log(uint8_t value);

/// depth_max: metres that 65535 would stand for, and the limit.
uint16_t encode_hri(float metres, float depth_max);
float decode_hri(uint16_t value, float depth_max);

/// How many finite depths lie beyond a limit in metres and were therefore encoded as none.
int64_t count_beyond(std::span<const float> metres, float limit);

}  // namespace pluvia
