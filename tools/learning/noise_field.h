// One field of Gaussian noise for a whole frame: a cell's value depends on seed, step, channel and place and on nothing
// else, so tiles that overlap start from the same noise.
#pragma once

#include <cstdint>
#include <vector>

namespace pluvia {

/// Independent values of mean 0 and variance 1, shape [channels, height, width]. x and y: cell of the first value,
/// counted from the frame's upper left corner; negative in the border. Source: Box and Muller 1958.
std::vector<float> noise_field(uint64_t seed, uint32_t step, int channels, int x, int y, int width, int height);

}  // namespace pluvia
