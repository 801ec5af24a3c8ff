// Adam with decoupled weight decay, a limit on the gradient, and a running mean of the weights, which is the result of
// a training. Source: Kingma and Ba 2015, Loshchilov and Hutter 2019.
#pragma once

#include "tools/learning/parameters.h"

#include <vector>

namespace pluvia {

class Adam {
public:
    /// weights: leaves that ask for gradients; they are changed in place.
    explicit Adam(NamedTensors weights);

    /// One step with the gradients that are there, which are then forgotten. step: how many were done before.
    /// A weight without gradient stays. Nothing is read back from the device.
    void update(double rate, int step);

    const NamedTensors& weights() const { return weights_; }
    /// The running mean of the weights, in their order.
    const std::vector<at::Tensor>& mean() const { return mean_; }
    /// All that is needed to go on: tensors by group, "weight.", "mean.", "first." and "second.".
    NamedTensors groups() const;

private:
    NamedTensors weights_;
    std::vector<at::Tensor> mean_, first_, second_;  // of the weights, of gradients and of their squares
};

}  // namespace pluvia
