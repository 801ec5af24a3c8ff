#include "tools/augment/npy_file.h"

#include "renderer/core/error.h"

#include <fmt/format.h>

#include <cstring>
#include <fstream>
#include <regex>
#include <vector>

namespace pluvia {

Image<float> read_npy(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw input_error(path, fmt::format("cannot be opened ({})", std::strerror(errno)));
    unsigned char start[8] = {};
    file.read(reinterpret_cast<char*>(start), 8);
    if (!file || std::memcmp(start, "\x93NUMPY", 6) != 0) throw input_error(path, "is no .npy file");
    unsigned char size[4] = {};
    file.read(reinterpret_cast<char*>(size), start[6] == 1 ? 2 : 4);
    const size_t length = size_t(size[0]) | size_t(size[1]) << 8 | size_t(size[2]) << 16 | size_t(size[3]) << 24;
    if (!file || length > 65536) throw input_error(path, "has a damaged header");
    std::string header(length, ' ');
    file.read(header.data(), std::streamsize(length));
    std::smatch type, shape;
    if (!file || !std::regex_search(header, type, std::regex("'descr': *'<f([48])'")))
        throw input_error(path, "does not hold little-endian float32 or float64");
    if (header.find("'fortran_order': False") == std::string::npos) throw input_error(path, "is not in C order");
    if (!std::regex_search(header, shape, std::regex("'shape': *\\((\\d{1,5}), *(\\d{1,5})(, *1)*,? *\\)")))
        throw input_error(path, "has another shape (expected height, width)");
    const int height = std::stoi(shape[1]), width = std::stoi(shape[2]);
    if (width < 1 || height < 1 || width > 32768 || height > 32768)
        throw input_error(path, fmt::format("is too large or empty (got {} x {})", width, height));
    const bool is_double = type[1] == "8";
    Image<float> image(width, height);
    std::vector<double> row(static_cast<size_t>(width));
    for (int y = 0; y < height; ++y) {
        float* const values = &image.at(0, y);
        if (is_double) {
            file.read(reinterpret_cast<char*>(row.data()), width * 8);
            for (int x = 0; x < width; ++x) values[x] = float(row[size_t(x)]);
        } else {
            file.read(reinterpret_cast<char*>(values), width * 4);
        }
        if (!file) throw input_error(path, fmt::format("ends in row {} of {}", y, height));
    }
    return image;
}

}  // namespace pluvia
