// Checksums: XXH3 of files and texts (the xxhash door), and SHA-256, which dataset metadata asks for.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace pluvia {

/// XXH3, 64 bits.
uint64_t hash_text(std::string_view text);
/// The same of a file's bytes as 16 hexadecimal digits; empty when it cannot be read.
std::string hash_file(const std::string& path);

/// SHA-256 of bytes as 64 hexadecimal digits. Source: FIPS 180-4.
std::string sha256(std::string_view bytes);

}  // namespace pluvia
