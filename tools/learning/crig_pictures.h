// Rain pictures by CRIGNet, one after the other, as the published script draws them from a seed.
// No header of libtorch is needed to call this.
#pragma once

#include "renderer/core/rgb.h"
#include "renderer/image/image.h"
#include "tools/learning/crig_config.h"

#include <memory>
#include <optional>
#include <string>

namespace pluvia {

struct CrigSettings {
    std::optional<CrigLabel> label;  // none: another for each picture, uniform in -1..1
    bool one_latent = false;         // the same for all pictures
    uint64_t seed = 123;
    // What the published script does, and what can be had instead.
    bool evaluation = false;  // stored statistics; published: those of each picture, and norms that move on
    bool noise = true;        // within the network, another for each picture
    bool rounded = false;     // bytes to the nearest; published: cut off
};

struct CrigPicture {
    CrigLabel label;
    Image<Rgba8> image;  // 256 x 256
};

/// The pictures of a seed. Each depends on how many came before it, so those that are not wanted are skipped.
class CrigPictures {
public:
    /// device: "cpu" or "cuda". Throws Error (input) for files that are damaged or hold no CRIGNet.
    CrigPictures(const std::string& path, const CrigSettings& settings, const std::string& device = "cpu");
    ~CrigPictures();

    CrigPicture next();
    /// next() without drawing; returns its label.
    CrigLabel skip();

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace pluvia
