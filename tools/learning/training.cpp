#include "tools/learning/training.h"

#include "renderer/core/error.h"
#include "renderer/core/random.h"
#include "tools/learning/blend.h"
#include "tools/learning/rain_model.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <numbers>
#include <numeric>

namespace pluvia {
namespace {

constexpr double beta1 = 0.9, beta2 = 0.999, epsilon = 1e-8, weight_decay = 1e-4;
constexpr double mean_decay = 0.999;  // of the running mean of weights; it starts faster
constexpr double max_gradient = 1;    // length of all gradients together
constexpr int warm_up = 100;          // steps of a rising learning rate

struct Crops {
    at::Tensor input, truth, rain;  // [batch, 4, n, n], [batch, 3, n, n], [batch, 1, n, n]
};

/// Where and how a crop is taken: pure functions of (seed, step, place in the batch).
struct Crop {
    size_t pair;
    int x, y;
    bool mirrored;
};

Crop choose_crop(const std::vector<TrainingPair>& pairs, const TrainingSettings& s, int step, int i) {
    const uint64_t key = hash_key(s.seed, uint64_t(step), uint64_t(i));
    const auto below = [&](uint64_t draw, int n) { return int(unit_double(mix_bits(key + draw)) * n); };
    Crop crop;
    crop.pair = size_t(below(1, int(pairs.size())));
    const Image<Rgba8>& picture = pairs[crop.pair].background;
    crop.x = below(2, picture.width - s.crop + 1);
    crop.y = below(3, picture.height - s.crop + 1);
    crop.mirrored = below(4, 2) == 1;
    return crop;
}

Crops take_crops(const std::vector<TrainingPair>& pairs, const TrainingSettings& s, int step) {
    const int64_t n = s.crop;
    Crops crops{at::empty({s.batch, regression_channels, n, n}), at::empty({s.batch, 3, n, n}),
                at::empty({s.batch, 1, n, n})};
    float *input = crops.input.data_ptr<float>(), *truth = crops.truth.data_ptr<float>(),
          *rain = crops.rain.data_ptr<float>();
    const int64_t plane = n * n;
    for (int i = 0; i < s.batch; ++i) {
        const Crop crop = choose_crop(pairs, s, step, i);
        const TrainingPair& pair = pairs[crop.pair];
        for (int64_t y = 0; y < n; ++y)
            for (int64_t x = 0; x < n; ++x) {
                const int from_x = crop.x + int(crop.mirrored ? n - 1 - x : x), from_y = crop.y + int(y);
                const Rgba8 clean = pair.background.at(from_x, from_y), wet = pair.rainy.at(from_x, from_y);
                const uint8_t alpha = pair.coverage.at(from_x, from_y);
                const int64_t at = y * n + x;
                const uint8_t from[3] = {clean.r, clean.g, clean.b}, to[3] = {wet.r, wet.g, wet.b};
                for (int64_t c = 0; c < 3; ++c) {
                    input[(i * regression_channels + c) * plane + at] = float(from[c]) / 127.5f - 1;
                    truth[(i * 3 + c) * plane + at] = float(to[c]) / 127.5f - 1;
                }
                input[(i * regression_channels + 3) * plane + at] = float(alpha) / 255;
                rain[i * plane + at] = alpha >= rain_alpha ? 1.0f : 0.0f;
            }
    }
    return crops;
}

nlohmann::json to_json(const TrainingSettings& s) {
    return {{"channels", s.channels}, {"multipliers", s.multipliers},     {"batch", s.batch},
            {"crop", s.crop},         {"learning_rate", s.learning_rate}, {"steps", s.steps},
            {"seed", s.seed}};
}

void check(const std::vector<TrainingPair>& pairs, const TrainingSettings& s) {
    const auto require = [](bool ok, const char* option, auto got, const char* expected) {
        if (!ok) throw usage_error(option, fmt::format("is not valid (got {}, expected {})", got, expected));
    };
    const int unit = 1 << (s.multipliers.size() - 1);
    require(s.channels >= 8 && s.channels <= 256 && s.channels % 8 == 0, "--channels", s.channels,
            "a multiple of 8 up to 256");
    require(s.batch >= 1 && s.batch <= 256, "--batch", s.batch, "1 to 256");
    require(s.crop >= unit && s.crop <= 1024 && s.crop % unit == 0, "--crop", s.crop,
            "up to 1024 pixels, a multiple of what the network halves, 8 by default");
    require(s.steps >= 1 && s.steps <= 100'000'000, "--steps", s.steps, "1 to 100000000");
    require(s.learning_rate > 0 && s.learning_rate <= 1, "--learning-rate", s.learning_rate, "above 0, up to 1");
    if (pairs.empty()) throw input_error("learn train", "there are no pairs to learn from");
    for (const TrainingPair& p : pairs) {
        const auto same = [&](const auto& image) {
            return image.width == p.background.width && image.height == p.background.height;
        };
        if (!same(p.coverage) || !same(p.rainy) || p.background.width < s.crop || p.background.height < s.crop)
            throw input_error(
                "learn train",
                fmt::format("a pair's pictures differ in size or are smaller than a crop of {} pixels", s.crop));
    }
}

}  // namespace

struct Trainer::State {
    std::vector<TrainingPair> pairs;
    TrainingSettings settings;
    std::vector<std::pair<std::string, at::Tensor>> weights;  // in the order in which the network asks for them
    std::vector<at::Tensor> mean, first, second;              // of the weights, of gradients and of their squares
    ModelConfig config;
    std::optional<UNet> unet;
    int step = 0;

    State(std::vector<TrainingPair> pairs_, const TrainingSettings& s) : pairs(std::move(pairs_)), settings(s) {
        check(pairs, s);
        config.kind = ModelConfig::Kind::regression;
        config.unet = {.in_channels = regression_channels,
                       .channels = s.channels,
                       .multipliers = s.multipliers,
                       .res_blocks = 1,
                       .attention_factors = {},
                       .head_width = std::gcd(int64_t(32), s.channels * s.multipliers.back())};
        const at::Device device = device_named(s.device);
        Parameters fresh([source = fresh_parameters(s.seed), device](const std::string& name, const TensorShape& shape,
                                                                     const Start& start) {
            return source.get(name, shape, start).to(device).set_requires_grad(true);
        });
        unet.emplace(recorded_parameters(fresh, weights), config.unet);
        for (const auto& [name, tensor] : weights) {
            mean.push_back(tensor.detach().clone());
            first.push_back(at::zeros_like(tensor));
            second.push_back(at::zeros_like(tensor));
        }
    }

    double learning_rate() const {
        const double rise = std::min(1.0, (step + 1.0) / warm_up), done = double(step) / settings.steps;
        return settings.learning_rate * rise * 0.5 * (1 + std::cos(std::numbers::pi * done));
    }

    void update_weights() {
        const at::NoGradGuard no_gradients;
        double length = 0;
        for (const auto& [name, w] : weights)
            if (w.grad().defined()) length += w.grad().square().sum().item<double>();
        const double scale = std::min(1.0, max_gradient / (std::sqrt(length) + 1e-12)), rate = learning_rate();
        const double bias1 = 1 - std::pow(beta1, step + 1), bias2 = 1 - std::pow(beta2, step + 1);
        const double decay = std::min(mean_decay, (1.0 + step) / (10.0 + step));
        for (size_t i = 0; i < weights.size(); ++i) {
            at::Tensor w = weights[i].second;
            if (w.grad().defined()) {
                const at::Tensor gradient = w.grad() * scale;
                first[i].mul_(beta1).add_(gradient, 1 - beta1);
                second[i].mul_(beta2).addcmul_(gradient, gradient, 1 - beta2);
                w.mul_(1 - rate * weight_decay);
                w.addcdiv_(first[i] / bias1, (second[i] / bias2).sqrt() + epsilon, -rate);
                w.mutable_grad() = at::Tensor();
            }
            mean[i].mul_(decay).add_(w.detach(), 1 - decay);
        }
    }

    /// Tensors by group: "weight.", "mean.", "first.", "second.".
    std::vector<std::pair<std::string, at::Tensor>> groups() const {
        std::vector<std::pair<std::string, at::Tensor>> all;
        for (size_t i = 0; i < weights.size(); ++i) {
            const std::string& name = weights[i].first;
            all.insert(all.end(), {{"weight." + name, weights[i].second.detach()},
                                   {"mean." + name, mean[i]},
                                   {"first." + name, first[i]},
                                   {"second." + name, second[i]}});
        }
        return all;
    }
};

namespace {

/// Written tensors must outlive the call, so they are kept here.
void write_tensors(const std::string& path, const std::map<std::string, std::string>& metadata,
                   const std::vector<std::pair<std::string, at::Tensor>>& tensors, TensorType type) {
    std::vector<at::Tensor> kept;
    std::vector<WrittenTensor> written;
    for (const auto& [name, tensor] : tensors) {
        kept.push_back(tensor.to(at::kCPU).contiguous());
        written.push_back({name, tensor.sizes().vec(), {kept.back().data_ptr<float>(), size_t(kept.back().numel())}});
    }
    write_safetensors(path, metadata, written, type);
}

}  // namespace

Trainer::Trainer(std::vector<TrainingPair> pairs, const TrainingSettings& settings)
    : state_(std::make_unique<State>(std::move(pairs), settings)) {}
Trainer::~Trainer() = default;

int Trainer::step() const {
    return state_->step;
}

double Trainer::train_step() {
    State& s = *state_;
    const Crops crops = take_crops(s.pairs, s.settings, s.step);
    const at::Device device = s.weights.front().second.device();
    const at::Tensor input = crops.input.to(device), rain = crops.rain.to(device);
    const at::Tensor time = at::zeros({input.size(0)}, input.options());
    const at::Tensor predicted = input.narrow(1, 0, 3) + (*s.unet)(input, time);
    const at::Tensor error = (predicted - crops.truth.to(device)) * 0.5 * rain;  // of display values 0..1
    const at::Tensor loss = error.square().sum() / (3 * rain.sum() + 1e-6);
    const double value = loss.item<double>();
    if (!std::isfinite(value))
        throw Error(ExitCode::render_failed, "learn train", fmt::format("the loss is not finite at step {}", s.step));
    loss.backward();
    s.update_weights();
    ++s.step;
    return value;
}

void Trainer::save(const std::string& path) const {
    write_tensors(path, {{"step", std::to_string(state_->step)}, {"settings", to_json(state_->settings).dump()}},
                  state_->groups(), TensorType::f32);
}

void Trainer::load(const std::string& path) {
    const at::NoGradGuard no_gradients;
    SafetensorsFile file(path);
    const auto stored = [&](const char* key) {
        const auto found = file.metadata().find(key);
        if (found == file.metadata().end()) throw input_error(path, "is no checkpoint of a training");
        return found->second;
    };
    const std::string settings = to_json(state_->settings).dump();
    if (stored("settings") != settings)
        throw input_error(path, fmt::format("was saved with other settings (got {}, expected {})",
                                            stored("settings").substr(0, 400), settings));
    const std::string step = stored("step");
    if (step.empty() || step.size() > 9 || step.find_first_not_of("0123456789") != std::string::npos)
        throw input_error(path, "has no valid number of steps");
    for (auto& [name, tensor] : state_->groups()) {
        const auto found = file.entries().find(name);
        if (found == file.entries().end() || found->second.shape != tensor.sizes().vec())
            throw input_error(path,
                              fmt::format("has no tensor \"{}\" of shape {}", name, shape_text(tensor.sizes().vec())));
        at::Tensor values = at::empty(tensor.sizes(), at::kFloat);
        file.read(name, {values.data_ptr<float>(), size_t(values.numel())});
        tensor.copy_(values);
    }
    state_->step = std::stoi(step);
}

void Trainer::save_model(const std::string& path, const std::string& note) const {
    std::vector<std::pair<std::string, at::Tensor>> model;
    for (size_t i = 0; i < state_->weights.size(); ++i)
        model.emplace_back(unet_prefix + state_->weights[i].first, state_->mean[i]);
    auto metadata = model_metadata(state_->config);
    metadata["training"] = note;
    write_tensors(path, metadata, model, TensorType::f16);
}

}  // namespace pluvia
