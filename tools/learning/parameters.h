// Where a network's tensors come from: a file of weights, a seed, or nowhere when only their names are asked for.
// Layers ask for each tensor by name and shape while they are built, so a network and its list of keys cannot differ.
#pragma once

#include "tools/learning/network_config.h"

#include <ATen/ATen.h>
#include <c10/core/GradMode.h>

#include <functional>
#include <memory>
#include <string>

namespace pluvia {

/// What an untrained tensor holds.
struct Start {
    enum Kind { uniform, one, zero } kind = uniform;
    int64_t fan_in = 1;       // uniform: within 1 / sqrt(fan_in), as torch starts its layers
    bool last_layer = false;  // zero because the block is to begin as the identity
};

/// Tensors in an order.
using NamedTensors = std::vector<std::pair<std::string, at::Tensor>>;

class Parameters {
public:
    using Source = std::function<at::Tensor(const std::string& name, const TensorShape& shape, const Start& start)>;

    explicit Parameters(Source source, std::string prefix = "")
        : source_(std::move(source)), prefix_(std::move(prefix)) {}

    /// The parameters of a part: names get "part." in front.
    Parameters part(const std::string& name) const { return Parameters(source_, prefix_ + name + "."); }
    Parameters part(int64_t index) const { return part(std::to_string(index)); }

    at::Tensor get(const std::string& name, const TensorShape& shape, const Start& start) const {
        return source_(prefix_ + name, shape, start);
    }

private:
    Source source_;
    std::string prefix_;
};

/// Reads from a file. Throws Error (input) when a tensor is missing or has another shape.
Parameters stored_parameters(std::shared_ptr<SafetensorsFile> file, const std::string& prefix, at::Device device);

/// Fresh values, each a pure function of (seed, name, index). everywhere: also where training starts from zero or one,
/// so that a test notices every tensor.
Parameters fresh_parameters(uint64_t seed, bool everywhere = false);

/// Notes names and shapes and makes nothing: tensors are undefined.
Parameters listed_parameters(TensorShapes& list);

/// Passes on what a source gives and keeps it by name, for training and saving.
Parameters recorded_parameters(Parameters source, NamedTensors& kept);

}  // namespace pluvia
