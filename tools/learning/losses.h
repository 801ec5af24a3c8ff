// What training makes small.
#pragma once

#include "tools/learning/crops.h"
#include "tools/learning/unet.h"

namespace pluvia {

/// Mean squared difference of display values over pixels with rain, between the truth and the clean picture with what
/// the network adds.
at::Tensor regression_loss(const UNet& unet, const Crops& crops);

/// L_LDM + L_GDM of "Learning from Rendering" for models without a first stage: each network is to tell the velocity
/// (signal * noise - noise_share * clean; Salimans and Ho 2022) of cells at random times, the guide of the streaks'
/// light, the main model of the change of the picture while it looks at the true streaks. Cells without rain hardly
/// count, since they are known. seed, step: of times and noise.
at::Tensor diffusion_loss(const UNet& unet, const UNet& guide, const ModelConfig& config, const Crops& crops,
                          uint64_t seed, int step);

}  // namespace pluvia
