// LPIPS 0.1: how different two pictures look to a network that learned to recognise things.
// Source: Zhang et al. 2018; AlexNet and VGG16 with torchvision's keys, linear heads with those of lpips.
#pragma once

#include "tools/learning/layers.h"

#include <string>
#include <vector>

namespace pluvia {

enum class LpipsNetwork { alex, vgg };

class Lpips {
public:
    Lpips(const Parameters& p, LpipsNetwork network);

    /// a, b: [1, 3, height, width] in 0..1, sides from 32 on. Symmetric; 0 for equal pictures.
    double operator()(const at::Tensor& a, const at::Tensor& b) const;

private:
    struct Layer {
        Convolution conv;
        bool pooled, compared;  // before the convolution; after its activation
    };
    std::vector<at::Tensor> compared_features(const at::Tensor& picture) const;

    LpipsNetwork network_;
    std::vector<Layer> layers_;
    std::vector<at::Tensor> heads_;  // [1, channels, 1, 1]
};

}  // namespace pluvia
