// What plain PyTorch answered, as the fixture scripts stored it.
#pragma once

#include "tools/learning/parameters.h"
#include "tools/learning/safetensors.h"

namespace pluvia {

inline SafetensorsFile open_fixture(const std::string& name) {
    return SafetensorsFile(std::string(PLUVIA_SOURCE_DIR) + "/tests/learning/" + name + ".safetensors");
}

inline at::Tensor stored_tensor(SafetensorsFile& file, const std::string& name) {
    const TensorEntry& entry = file.entries().at(name);
    at::Tensor tensor = at::empty(entry.shape, at::kFloat);
    file.read(name, {tensor.data_ptr<float>(), size_t(tensor.numel())});
    return tensor;
}

}  // namespace pluvia
