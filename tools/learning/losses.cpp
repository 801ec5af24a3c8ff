#include "tools/learning/losses.h"

#include "renderer/core/random.h"
#include "tools/learning/rain_model.h"

namespace pluvia {
namespace {

constexpr double known_weight = 0.05;  // of pixels without rain, where a pixel with rain has 1

/// Cells at random times, and what a network has to tell of them.
struct Noised {
    at::Tensor time;  // [batch]
    at::Tensor cells, velocity;
};

/// clean: [batch, channels, height, width].
Noised add_noise(const at::Tensor& clean, const DiffusionConfig& config) {
    const std::vector<double> shares = alphas_cumprod(config);
    const at::Tensor table = at::tensor(at::ArrayRef<double>(shares), at::kDouble).to(at::kFloat).to(clean.device());
    Noised n;
    n.time = at::randint(config.times, {clean.size(0)}, at::TensorOptions(at::kLong).device(clean.device()));
    const at::Tensor share = table.index_select(0, n.time).reshape({-1, 1, 1, 1});
    const at::Tensor signal = share.sqrt(), noise_share = (1 - share).sqrt(), noise = at::randn_like(clean);
    n.cells = signal * clean + noise_share * noise;
    n.velocity = signal * noise - noise_share * clean;
    n.time = n.time.to(at::kFloat);
    return n;
}

}  // namespace

at::Tensor regression_loss(const UNet& unet, const Crops& c) {
    const at::Tensor input = at::cat({c.background, seen_coverage(c.coverage)}, 1);
    const at::Tensor time = at::zeros({input.size(0)}, input.options());
    const at::Tensor error = (c.background + unet(input, time) - c.truth) * 0.5 * c.rain;  // of display values 0..1
    return error.square().sum() / (3 * c.rain.sum() + 1e-6);
}

at::Tensor diffusion_loss(const UNet& unet, const UNet& guide, const ModelConfig& config, const Crops& c, uint64_t seed,
                          int step) {
    at::manual_seed(hash_key(seed, uint64_t(step), 0x6e6f697365ull));
    const auto fold = [&](const at::Tensor& pixels) { return at::pixel_unshuffle(pixels, config.fold); };
    const at::Tensor condition = fold(at::cat({c.background, seen_coverage(c.coverage)}, 1));
    const at::Tensor weight = fold(c.rain.expand({-1, 3, -1, -1}) * (1 - known_weight) + known_weight);
    const at::Tensor streaks = fold(c.streaks), change = fold(c.truth - c.background);
    const auto loss = [&](const UNet& network, const at::Tensor& clean, const at::Tensor& context) {
        const Noised n = add_noise(clean, config.diffusion);
        const at::Tensor told = network(at::cat({n.cells, condition}, 1), n.time, context);
        return ((told - n.velocity).square() * weight).sum() / weight.sum();
    };
    return loss(guide, streaks, {}) + loss(unet, change, guide_tokens(streaks));
}

}  // namespace pluvia
