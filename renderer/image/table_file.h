// A table of numbers in a file that may be lost at any time: kept to save the
// time of making it again, and never trusted blindly.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pluvia {

/// The numbers that write_table() left under a key. Empty when there is no such
/// file, when it was written for another key or number of values, is damaged,
/// or holds a value that is not finite. Never throws.
std::optional<std::vector<float>> read_table(const std::string& path, uint64_t key, size_t count);

/// Writes beside the path and renames, so that no reader meets half a file;
/// makes the folder where it is missing. False when that is impossible. Never
/// throws.
bool write_table(const std::string& path, uint64_t key, const std::vector<float>& values);

}  // namespace pluvia
