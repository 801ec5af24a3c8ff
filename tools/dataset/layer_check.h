// Whether the layers of a frame are finite and add up, before anything is rounded for a picture.
#pragma once

#include "renderer/transport/layers.h"

#include <cstdint>
#include <string>
#include <vector>

namespace pluvia {

/// Largest share of its parts by which a rainy pixel may miss background x transmittance + rain + inscatter: float
/// rounding of the four is 2e-7.
constexpr double residual_limit = 2e-6;

class LayerCheck {
public:
    explicit LayerCheck(const std::vector<double>& intensities);

    /// band: planes in the order of layer_channels(), then labels, which must be numbers.
    void look(const Band& band);

    int64_t not_finite() const { return not_finite_; }
    double residual() const { return residual_; }

private:
    const std::vector<float>& plane(const Band& band, const std::string& name) const;

    std::vector<std::string> names_, labels_;
    int64_t not_finite_ = 0;
    double residual_ = 0;
};

/// The same of a finished file. Throws Error (input) when it lacks a layer.
LayerCheck checked_layers(const std::string& exr, const std::vector<double>& intensities);

}  // namespace pluvia
