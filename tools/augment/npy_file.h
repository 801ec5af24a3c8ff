// Arrays of numbers as NumPy writes them, .npy: depth in metres.
// Source: NEP 1 and its successors, format versions 1 to 3.
#pragma once

#include "renderer/image/image.h"

#include <string>

namespace pluvia {

/// shape: height, width, perhaps followed by ones. Little-endian float32 or float64 in C order. Throws Error (input)
/// with the file for anything else and where it ends too early.
Image<float> read_npy(const std::string& path);

}  // namespace pluvia
