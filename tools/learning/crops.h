// Training pairs in a device's memory, and crops of them. Every crop is a pure function of seed and step, so training
// that was interrupted goes on as if it had not been.
#pragma once

#include "tools/learning/training.h"

#include <ATen/ATen.h>

#include <vector>

namespace pluvia {

/// A step's crops, on the device: [batch, channels, crop, crop].
struct Crops {
    at::Tensor background, truth;  // 3 channels, -1..1
    at::Tensor streaks;            // 3 channels, 0..2: light of the streaks alone, 0 without rain
    at::Tensor coverage;           // 0..1
    at::Tensor rain;               // 1 where there is rain, else 0
};

class TrainingPictures {
public:
    TrainingPictures(const std::vector<TrainingPair>& pairs, at::Device device);
    Crops take(const TrainingSettings& settings, int step) const;

private:
    std::vector<at::Tensor> pictures_;  // [10, height, width] bytes: background, truth, streaks, coverage
};

}  // namespace pluvia
