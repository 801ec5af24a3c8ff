#include "tools/labels/flow_file.h"

#include "renderer/core/error.h"
#include "renderer/image/image_io.h"
#include "renderer/image/pending_file.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <fstream>
#include <sstream>

namespace pluvia {
namespace {

constexpr float flo_magic = 202021.25f, flo_unknown = 1e10f, flo_limit = 1e9f;

void put_word(std::string& bytes, uint32_t word) {
    for (int k = 0; k < 4; ++k) bytes += char(word >> (8 * k));
}
uint32_t word_at(const std::string& bytes, size_t at) {
    uint32_t word = 0;
    for (size_t k = 0; k < 4; ++k) word |= uint32_t(static_cast<unsigned char>(bytes[at + k])) << (8 * k);
    return word;
}

}  // namespace

void write_flo(const std::string& path, const Flow& flow) {
    std::string bytes;
    put_word(bytes, std::bit_cast<uint32_t>(flo_magic));
    put_word(bytes, uint32_t(flow.width)), put_word(bytes, uint32_t(flow.height));
    for (size_t i = 0; i < flow.u.size(); ++i)
        for (const float value : {flow.u[i], flow.v[i]})
            put_word(bytes, std::bit_cast<uint32_t>(flow.valid[i] ? value : flo_unknown));
    PendingFile file(path);
    file.stream() << bytes;
    file.commit();
}

Flow read_flo(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw input_error(path, "cannot be opened");
    std::ostringstream text;
    text << file.rdbuf();
    const std::string bytes = text.str();
    if (bytes.size() < 12 || std::bit_cast<float>(word_at(bytes, 0)) != flo_magic)
        throw input_error(path, "is no .flo file (expected 202021.25 in its first four bytes)");
    Flow flow{int(word_at(bytes, 4)), int(word_at(bytes, 8)), {}, {}, {}};
    if (flow.width < 1 || flow.height < 1 || flow.width > 32768 || flow.height > 32768 ||
        bytes.size() != 12 + 8 * size_t(flow.width) * size_t(flow.height))
        throw input_error(path, fmt::format("has the wrong size (got {} bytes for {} x {} pixels)", bytes.size(),
                                            flow.width, flow.height));
    for (size_t at = 12; at < bytes.size(); at += 8) {
        const float u = std::bit_cast<float>(word_at(bytes, at)), v = std::bit_cast<float>(word_at(bytes, at + 4));
        const bool valid = std::abs(u) < flo_limit && std::abs(v) < flo_limit;  // false for NaN
        flow.u.push_back(valid ? u : 0), flow.v.push_back(valid ? v : 0), flow.valid.push_back(valid);
    }
    return flow;
}

void write_kitti_flow(const std::string& path, const Flow& flow) {
    std::vector<uint16_t> values;
    for (size_t i = 0; i < flow.u.size(); ++i) {
        const double u = std::round(64.0 * flow.u[i] + 32768), v = std::round(64.0 * flow.v[i] + 32768);
        const bool valid = flow.valid[i] && u >= 0 && u <= 65535 && v >= 0 && v <= 65535;
        values.push_back(valid ? uint16_t(u) : 0), values.push_back(valid ? uint16_t(v) : 0);
        values.push_back(valid);
    }
    PngWriter writer(path, flow.width, flow.height, 3, 16);
    writer.write_rows(0, flow.height, values.data());
    writer.finish();
}

Flow read_kitti_flow(const std::string& path) {
    const ImageInfo info = read_image_info(path);
    if (info.channels != 3 || info.bits != 16)
        throw input_error(path, fmt::format("is no flow of KITTI (got {} channels of {} bits, expected 3 of 16)",
                                            info.channels, info.bits));
    const Image<Rgb> image = read_display(path);
    Flow flow{image.width, image.height, {}, {}, {}};
    for (const Rgb& p : image.pixels) {
        const bool valid = p.b > 0;
        flow.u.push_back(valid ? (std::round(p.r * 65535) - 32768) / 64 : 0);
        flow.v.push_back(valid ? (std::round(p.g * 65535) - 32768) / 64 : 0);
        flow.valid.push_back(valid);
    }
    return flow;
}

}  // namespace pluvia
