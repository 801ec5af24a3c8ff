#include "tools/learning/parameters.h"

#include "renderer/core/error.h"
#include "renderer/core/random.h"

#include <fmt/format.h>

namespace pluvia {
namespace {

/// FNV-1a, 64 bits.
uint64_t name_key(const std::string& name) {
    uint64_t h = 0xcbf29ce484222325ull;
    for (const char c : name) h = (h ^ uint8_t(c)) * 0x100000001b3ull;
    return h;
}

}  // namespace

Parameters stored_parameters(std::shared_ptr<SafetensorsFile> file, const std::string& prefix, at::Device device) {
    return Parameters(
        [file, device](const std::string& name, const TensorShape& shape, const Start&) {
            const auto found = file->entries().find(name);
            if (found != file->entries().end() && found->second.shape != shape)
                throw input_error(file->path(), fmt::format("tensor \"{}\" has the wrong shape (got {}, expected {})",
                                                            name, shape_text(found->second.shape), shape_text(shape)));
            if (found == file->entries().end())
                throw input_error(file->path(), fmt::format("has no tensor \"{}\"", name));
            at::Tensor tensor = at::empty(shape, at::kFloat);
            file->read(name, {tensor.data_ptr<float>(), size_t(tensor.numel())});
            return tensor.to(device);
        },
        prefix);
}

Parameters fresh_parameters(uint64_t seed, bool everywhere) {
    return Parameters([seed, everywhere](const std::string& name, const TensorShape& shape, const Start& start) {
        if (!everywhere && (start.kind != Start::uniform || start.last_layer))
            return at::full(shape, start.kind == Start::one ? 1.0 : 0.0, at::kFloat);
        const float centre = start.kind == Start::one ? 1 : 0;
        const float reach = start.kind == Start::uniform ? float(1 / std::sqrt(double(start.fan_in))) : 0.2f;
        at::Tensor tensor = at::empty(shape, at::kFloat);
        float* values = tensor.data_ptr<float>();
        const uint64_t key = hash_key(seed, name_key(name));
        for (int64_t i = 0; i < tensor.numel(); ++i)
            values[i] = centre + reach * (2 * unit_float(mix_bits(key + uint64_t(i))) - 1);
        return tensor;
    });
}

Parameters listed_parameters(TensorShapes& list) {
    return Parameters([&list](const std::string& name, const TensorShape& shape, const Start&) {
        list[name] = shape;
        return at::Tensor();
    });
}

Parameters recorded_parameters(Parameters source, NamedTensors& kept) {
    return Parameters([source, &kept](const std::string& name, const TensorShape& shape, const Start& start) {
        kept.emplace_back(name, source.get(name, shape, start));
        return kept.back().second;
    });
}

}  // namespace pluvia
