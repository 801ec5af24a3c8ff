// The reference of `pluvia validate trade`: batches of samples with seeds of their own, each kept in a file, so that an
// interrupted one goes on and a better one adds to what is there.
#pragma once

#include "tools/validate/trade.h"

namespace pluvia {

struct TradeReference {
    JudgedLayers layers;
    int samples = 0;
    double error =
        0;  // its own, of the worse layer: square root of the trimmed relMSE, by the difference of its halves
};

constexpr int reference_batch = 128;  // samples per pixel

/// samples: rounded up to two batches or more. folder: of the batches' files. progress: told the share of what is left
/// to do, 0 to 1; false stops with Error (stopped_early).
TradeReference find_reference(const TradeScene& scene, const RenderSettings& settings, int samples,
                              const std::string& folder, const ProgressCallback& progress);

}  // namespace pluvia
