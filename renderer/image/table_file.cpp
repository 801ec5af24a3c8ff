#include "renderer/image/table_file.h"

#include "renderer/core/random.h"

#include <unistd.h>
#include <array>
#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>

namespace pluvia {
namespace {

constexpr uint64_t magic = 0x3142544156554c50;  // "PLUVATB1" as bytes of a little-endian file

struct Head {
    uint64_t magic, key, count, checksum;
};

uint64_t checksum_of(const std::vector<float>& values) {
    uint64_t sum = values.size();
    for (const float v : values) sum = hash_key(sum, std::bit_cast<uint32_t>(v));
    return sum;
}

}  // namespace

std::optional<std::vector<float>> read_table(const std::string& path, uint64_t key, size_t count) {
    std::ifstream file(path, std::ios::binary);
    Head head = {};
    if (!file.read(reinterpret_cast<char*>(&head), sizeof head)) return std::nullopt;
    if (head.magic != magic || head.key != key || head.count != count) return std::nullopt;
    std::vector<float> values(count);
    if (!file.read(reinterpret_cast<char*>(values.data()), std::streamsize(count * sizeof(float)))) return std::nullopt;
    if (file.peek() != std::ifstream::traits_type::eof() || checksum_of(values) != head.checksum) return std::nullopt;
    for (const float v : values)
        if (!std::isfinite(v)) return std::nullopt;
    return values;
}

bool write_table(const std::string& path, uint64_t key, const std::vector<float>& values) {
    namespace fs = std::filesystem;
    std::error_code error;
    fs::create_directories(fs::path(path).parent_path(), error);
    // Two programs may write at the same time; the name says whose file it is.
    const std::string temporary = path + "." + std::to_string(getpid()) + ".tmp";
    const Head head = {magic, key, values.size(), checksum_of(values)};
    std::ofstream file(temporary, std::ios::binary);
    file.write(reinterpret_cast<const char*>(&head), sizeof head);
    file.write(reinterpret_cast<const char*>(values.data()), std::streamsize(values.size() * sizeof(float)));
    file.close();
    if (file) fs::rename(temporary, path, error);
    if (!file || error) {
        std::error_code ignored;
        fs::remove(temporary, ignored);
        return false;
    }
    return true;
}

}  // namespace pluvia
