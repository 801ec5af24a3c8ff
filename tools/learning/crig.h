// CRIGNet's generator: a rain picture of 256 pixels, white streaks on black, of a latent and a label.
// Keys as in the published checkpoint. Source: Liu et al. 2021 (FastGAN); spectral norms: Miyato et al. 2018.
#pragma once

#include "tools/learning/crig_config.h"
#include "tools/learning/layers.h"

#include <functional>
#include <optional>
#include <vector>

namespace pluvia {

/// training: as published, where the network is never told that training is over. Normalisation then uses the
/// statistics of the one picture instead of the stored ones, and each picture moves the spectral norms on by a step.
enum class CrigMode { training, evaluation };

/// Normal noise of a height and width, [1, 1, height, width], or undefined for none.
using CrigNoise = std::function<at::Tensor(int64_t height, int64_t width)>;

class CrigNet {
public:
    CrigNet(const Parameters& p, const CrigConfig& config);

    /// One step of the power iteration by which spectral norms are estimated. In training mode a picture is preceded by
    /// one.
    void iterate_norms();

    /// input: [1, latent + 2], label last. noise is asked for six times, from 8 to 128 pixels. Returns [1, 3, 256,
    /// 256], about 0..1 and not clipped.
    at::Tensor operator()(const at::Tensor& input, CrigMode mode, const CrigNoise& noise) const;

    const CrigConfig& config() const { return config_; }

private:
    /// A convolution without bias whose weight is divided by its largest singular value.
    struct Spectral {
        at::Tensor weight, u, v;
        int64_t padding;
        bool transposed;

        Spectral(const Parameters& p, int64_t in, int64_t out, int64_t size, int64_t padding, bool transposed = false);
        at::Tensor matrix() const;  // [out, all else]
        void iterate();
        at::Tensor operator()(const at::Tensor& x) const;
    };
    /// Batch normalisation, then half of the channels gated by the other half.
    struct Gate {
        at::Tensor weight, bias, mean, variance;

        Gate(const Parameters& p, int64_t channels);
        at::Tensor operator()(const at::Tensor& x, CrigMode mode) const;
    };
    struct Up {
        Spectral conv;
        std::optional<at::Tensor> noise;  // its strength
        Gate gate;
    };
    /// Doubles the size; a block has one of these or two, of which the second keeps the size.
    using Block = std::vector<Up>;
    /// Channels of a fine picture weighed by what a coarse one holds.
    struct Excitation {
        Spectral squeeze, excite;

        Excitation(const Parameters& p, int64_t in, int64_t out);
        at::Tensor operator()(const at::Tensor& coarse, const at::Tensor& fine) const;
    };
    static Block make_block(const Parameters& p, int64_t in, int64_t out, bool two);
    static at::Tensor apply(const Block& block, const at::Tensor& x, CrigMode mode, const CrigNoise& noise);

    CrigConfig config_;
    Spectral start_;
    Gate start_gate_;
    Block blocks_[6];            // to 8, 16, ... 256 pixels
    Excitation excitations_[3];  // of 64, 128 and 256 pixels by 4, 8 and 16
    Spectral to_64_, to_128_;    // in the file, but used by no picture of 256 pixels
    Spectral to_picture_;
};

}  // namespace pluvia
