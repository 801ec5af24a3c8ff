#include "renderer/scene/gltf_meshopt.h"

#include "renderer/core/error.h"

#include <fmt/format.h>
#include <meshoptimizer.h>

namespace pluvia {
namespace {

constexpr const char* extension = "EXT_meshopt_compression";

// The densest that the format can be: an index triangle of 12 bytes in one, a block of equal vertices in 1 of 64.
constexpr uint64_t max_ratio = 256;

uint64_t number(const tinygltf::Value& object, const char* key, uint64_t otherwise, const std::string& where) {
    if (!object.Has(key)) return otherwise;
    const tinygltf::Value& value = object.Get(key);
    const double number = value.IsNumber() ? value.GetNumberAsDouble() : -1;
    if (!(number >= 0 && number < 0x1p53))
        throw input_error(where, fmt::format("{} of {} is not a count (got {})", key, extension, number));
    return uint64_t(number);
}

std::string text(const tinygltf::Value& object, const char* key) {
    return object.Has(key) && object.Get(key).IsString() ? object.Get(key).Get<std::string>() : "";
}

struct Stream {
    const unsigned char* bytes;
    size_t length, stride, count;
};

bool decode(const Stream& s, const std::string& mode, const std::string& filter, unsigned char* out,
            const std::string& where) {
    const bool is_vertices = mode == "ATTRIBUTES";
    const bool stride_fits =
        is_vertices ? s.stride % 4 == 0 && s.stride > 0 && s.stride <= 256 : s.stride == 2 || s.stride == 4;
    const bool filter_fits = filter.empty() || filter == "NONE" ||
                             (is_vertices && ((filter == "OCTAHEDRAL" && (s.stride == 4 || s.stride == 8)) ||
                                              (filter == "QUATERNION" && s.stride == 8) || filter == "EXPONENTIAL"));
    if (!stride_fits || !filter_fits || (mode == "TRIANGLES" && s.count % 3 != 0))
        throw input_error(where, fmt::format("has settings of {} that do not fit (got mode \"{}\", filter \"{}\", {} "
                                             "elements of {} bytes)",
                                             extension, mode, filter, s.count, s.stride));
    int failed = 1;
    if (is_vertices)
        failed = meshopt_decodeVertexBuffer(out, s.count, s.stride, s.bytes, s.length);
    else if (mode == "TRIANGLES")
        failed = meshopt_decodeIndexBuffer(out, s.count, s.stride, s.bytes, s.length);
    else if (mode == "INDICES")
        failed = meshopt_decodeIndexSequence(out, s.count, s.stride, s.bytes, s.length);
    if (failed) return false;
    if (filter == "OCTAHEDRAL") meshopt_decodeFilterOct(out, s.count, s.stride);
    if (filter == "QUATERNION") meshopt_decodeFilterQuat(out, s.count, s.stride);
    if (filter == "EXPONENTIAL") meshopt_decodeFilterExp(out, s.count, s.stride);
    return true;
}

}  // namespace

void unpack_meshopt(tinygltf::Model& model, const std::string& where) {
    const size_t file_buffers = model.buffers.size();
    for (size_t i = 0; i < model.bufferViews.size(); ++i) {
        tinygltf::BufferView& view = model.bufferViews[i];
        const auto found = view.extensions.find(extension);
        if (found == view.extensions.end()) continue;
        const std::string view_where = fmt::format("{}: buffer view {}", where, i);
        const tinygltf::Value& settings = found->second;
        const uint64_t source = number(settings, "buffer", file_buffers, view_where);
        if (source >= file_buffers)
            throw input_error(view_where, fmt::format("buffer of {} does not exist (got {}, expected below {})",
                                                      extension, source, file_buffers));
        const auto& bytes = model.buffers[source].data;
        const uint64_t offset = number(settings, "byteOffset", 0, view_where);
        const uint64_t length = number(settings, "byteLength", 0, view_where);
        if (offset > bytes.size() || length > bytes.size() - offset)
            throw input_error(view_where,
                              fmt::format("reaches outside of its buffer (got {} compressed bytes at {}, expected "
                                          "at most {})",
                                          length, offset, bytes.size()));
        const uint64_t stride = number(settings, "byteStride", 0, view_where),
                       count = number(settings, "count", 0, view_where);
        if (stride > 256 || count > max_ratio * (length + 16))
            throw input_error(view_where,
                              fmt::format("cannot hold what it claims (got {} elements of {} bytes in {} compressed "
                                          "bytes)",
                                          count, stride, length));
        tinygltf::Buffer unpacked;
        unpacked.data.resize(count * stride);
        const Stream stream{bytes.data() + offset, size_t(length), size_t(stride), size_t(count)};
        if (!decode(stream, text(settings, "mode"), text(settings, "filter"), unpacked.data.data(), view_where))
            throw input_error(view_where,
                              fmt::format("its compressed bytes are not valid (mode \"{}\")", text(settings, "mode")));
        view.buffer = int(model.buffers.size());
        view.byteOffset = 0;
        view.byteLength = unpacked.data.size();
        model.buffers.push_back(std::move(unpacked));
    }
}

}  // namespace pluvia
