#include "tools/learning/synthesis.h"

#include "renderer/core/error.h"
#include "tools/learning/noise_field.h"
#include "tools/learning/rain_model.h"
#include "tools/learning/tiled.h"

#include <fmt/format.h>

#include <optional>

namespace pluvia {
namespace {

constexpr uint32_t guide_noise = 1u << 16;  // steps of its noise begin here

/// A frame on its way through a diffusion model.
class Frame {
public:
    Frame(const RainModel& model, const Image<Rgba8>& background, const Image<uint8_t>& coverage,
          const SynthesisSettings& settings, const SynthesisProgress& progress)
        : model_(model),
          settings_(settings),
          plan_(plan_tiles(background.width, background.height, model.cell(), model.unit(), settings.tiles)),
          steps_(model.config.kind == ModelConfig::Kind::diffusion
                     ? ddim_steps(model.config.diffusion, settings.steps, settings.eta)
                     : std::vector<DdimStep>()),
          count_(total_tiles(), progress),
          width_(background.width),
          height_(background.height) {
        pad(background, coverage);
    }

    Image<Rgb> predict() {
        return picture(model_.config.kind == ModelConfig::Kind::regression ? regression() : diffusion());
    }

private:
    int total_tiles() const {
        if (steps_.empty()) return plan_.count();
        const int passes = int(steps_.size()) * (model_.guide ? 2 : 1);
        return plan_.count() * (passes + (!model_.first_stage ? 0 : settings_.anchor_latents ? 3 : 2));
    }

    /// Fills background_ [1, 3, h, w] in -1..1 and coverage_ [1, 1, h, w] in 0..1 of the padded frame: reflected beyond
    /// its borders, or black as published.
    void pad(const Image<Rgba8>& background, const Image<uint8_t>& coverage) {
        const int64_t h = plan_.y.padded, w = plan_.x.padded;
        background_ = at::full({1, 3, h, w}, -1.0f);
        coverage_ = at::zeros({1, 1, h, w});
        float *colors = background_.data_ptr<float>(), *alphas = coverage_.data_ptr<float>();
        for (int64_t y = 0; y < h; ++y)
            for (int64_t x = 0; x < w; ++x) {
                const int from_x = int(x) - plan_.x.before, from_y = int(y) - plan_.y.before;
                const bool outside = from_x < 0 || from_y < 0 || from_x >= width_ || from_y >= height_;
                if (outside && plan_.plain) continue;
                const int at_x = reflected(from_x, width_), at_y = reflected(from_y, height_);
                const Rgba8 p = background.at(at_x, at_y);
                const uint8_t bytes[3] = {p.r, p.g, p.b};
                for (int64_t c = 0; c < 3; ++c) colors[(c * h + y) * w + x] = float(bytes[c]) / 127.5f - 1;
                alphas[y * w + x] = float(coverage.at(at_x, at_y)) / 255;
            }
        background_ = background_.to(model_.device);
        coverage_ = coverage_.to(model_.device);
    }

    at::Tensor is_rain() const { return coverage_.mul(255).ge(rain_alpha - 0.5).to(at::kFloat); }

    at::Tensor over(int out_cell, const std::function<at::Tensor(int, int)>& body) {
        return over_tiles(plan_, out_cell, settings_.tiles.backwards, count_, body);
    }

    at::Tensor regression() {
        const at::Tensor time = at::zeros({1}, background_.options());
        const at::Tensor input = at::cat({background_, seen_coverage(coverage_)}, 1);
        return background_ + over(1, [&](int x, int y) { return (*model_.unet)(cut(input, plan_, 1, x, y), time); });
    }

    at::Tensor encode(const at::Tensor& pixels) {
        return over(model_.cell(),
                    [&](int x, int y) { return model_.first_stage->encode(cut(pixels, plan_, 1, x, y)); });
    }

    at::Tensor noise(uint32_t step) const {
        const int cell = model_.cell(), width = plan_.x.padded / cell, height = plan_.y.padded / cell;
        const int channels = int(model_.config.unet.out_channels);
        const auto values =
            noise_field(settings_.seed, step, channels, -plan_.x.before / cell, -plan_.y.before / cell, width, height);
        return at::tensor(at::ArrayRef<float>(values), at::kFloat)
            .reshape({1, channels, height, width})
            .to(model_.device);
    }

    /// Predicted noise of the whole frame: of every tile with its context, joined.
    at::Tensor predicted_noise(const UNet& unet, const at::Tensor& z, const at::Tensor& condition, const DdimStep& s,
                               const at::Tensor& guide) {
        const int cell = model_.cell();
        const at::Tensor at_time = at::full({1}, double(s.time), background_.options());
        const at::Tensor told = over(cell, [&](int x, int y) {
            const at::Tensor tokens = guide.defined() ? guide_tokens(cut(guide, plan_, cell, x, y)) : at::Tensor();
            return unet(at::cat({cut(z, plan_, cell, x, y), cut(condition, plan_, cell, x, y)}, 1), at_time, tokens);
        });
        return model_.config.tells_velocity ? s.noise_share * z + s.signal * told : told;
    }

    /// Where cells follow what is known, and what that is.
    struct Known {
        at::Tensor rain, clean;  // of cells: 1 where they are drawn, else 0; latent of the others; undefined: none

        at::Tensor hold(const at::Tensor& z, const DdimStep& s, const at::Tensor& noise) const {
            if (!rain.defined()) return z;
            return rain * z + (1 - rain) * (s.next_signal * clean + s.next_noise() * noise);
        }
    };

    Known known_cells() {
        Known known;
        const int cell = model_.cell();
        // One cell more than the rain covers, since a cell is decoded with those around it.
        if (settings_.anchor_latents)
            known.rain = at::max_pool2d(at::max_pool2d(is_rain(), {cell, cell}), {3, 3}, {1, 1}, {1, 1});
        if (known.rain.defined())
            known.clean = model_.first_stage ? encode(background_) : at::zeros({1}, background_.options());
        return known;
    }

    /// What the networks are given beside the cells. With a first stage rain is a hole: black, as published.
    at::Tensor condition() {
        if (model_.first_stage) return encode((background_ + 1) * (1 - is_rain()) - 1);
        return at::pixel_unshuffle(at::cat({background_, seen_coverage(coverage_)}, 1), model_.cell());
    }

    at::Tensor diffusion() {
        const at::Tensor given = condition();
        const Known known = known_cells();
        at::Tensor guide;
        if (model_.guide) {
            const at::Tensor start = noise(guide_noise);
            guide = start;
            for (const DdimStep& s : ddim_steps(model_.config.diffusion, settings_.steps, 0)) {
                const at::Tensor eps = predicted_noise(*model_.guide, guide, given, s, {});
                guide = s.x_factor() * guide + s.eps_factor() * eps;
                if (!model_.first_stage) guide = known.hold(guide, s, start);
            }
        }
        const at::Tensor start = noise(0);
        at::Tensor z = start;
        for (size_t i = 0; i < steps_.size(); ++i) {
            const DdimStep& s = steps_[i];
            const at::Tensor eps = predicted_noise(*model_.unet, z, given, s, guide);
            z = s.x_factor() * z + s.eps_factor() * eps;
            if (s.sigma > 0) z = z + s.sigma * noise(uint32_t(i) + 1);
            z = known.hold(z, s, start);
        }
        if (!model_.first_stage) return background_ + at::pixel_shuffle(z, model_.cell());
        return over(1, [&](int x, int y) { return model_.first_stage->decode(cut(z, plan_, model_.cell(), x, y)); });
    }

    /// The frame without its border, -1..1 to 0..1.
    Image<Rgb> picture(const at::Tensor& padded) const {
        const at::Tensor inside = ((padded + 1) / 2)
                                      .clamp(0, 1)
                                      .narrow(2, plan_.y.before, height_)
                                      .narrow(3, plan_.x.before, width_)
                                      .permute({0, 2, 3, 1})
                                      .to(at::kCPU)
                                      .contiguous();
        if (!at::isfinite(inside).all().item<bool>())
            throw Error(ExitCode::render_failed, "learn infer", "the network's answer is not finite");
        Image<Rgb> result(width_, height_);
        const float* values = inside.data_ptr<float>();
        for (size_t i = 0; i < result.pixels.size(); ++i)
            result.pixels[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
        return result;
    }

    const RainModel& model_;
    const SynthesisSettings& settings_;
    TilePlan plan_;
    std::vector<DdimStep> steps_;
    TileCount count_;
    int width_, height_;
    at::Tensor background_, coverage_;
};

}  // namespace

Image<Rgba8> synthesize(const RainModel& model, const Image<Rgba8>& background, const Image<uint8_t>& coverage,
                        const SynthesisSettings& settings, const SynthesisProgress& progress,
                        const std::string& where) {
    if (background.width != coverage.width || background.height != coverage.height)
        throw input_error(where, fmt::format("mask and background differ in size (got {}x{} and {}x{})", coverage.width,
                                             coverage.height, background.width, background.height));
    if (settings.steps < 1 || settings.steps > model.config.diffusion.times)
        throw usage_error("--steps", fmt::format("is not valid (got {}, expected 1 to {})", settings.steps,
                                                 model.config.diffusion.times));
    const c10::NoGradGuard no_gradients;
    Frame frame(model, background, coverage, settings, progress);
    BlendSettings how = settings.blend;
    // Only a first stage draws the picture anew, so that its colours are off and its rims show; and only such a model
    // does not see how much of a pixel a streak covers.
    if (!model.first_stage) how.soft = how.anchor_colors = false;
    return blend(frame.predict(), background, coverage, how);
}

}  // namespace pluvia
