#include "tools/learning/training.h"

#include "renderer/core/error.h"
#include "tools/learning/adam.h"
#include "tools/learning/losses.h"
#include "tools/learning/rain_model.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <numbers>
#include <numeric>

namespace pluvia {
namespace {

constexpr int warm_up = 100;  // steps of a rising learning rate
constexpr int fold = 4;       // pixels along a side of a diffusion model's cell

nlohmann::json to_json(const TrainingSettings& s) {
    return {{"kind", model_kind_name(s.kind)},
            {"channels", s.channels},
            {"multipliers", s.multipliers},
            {"batch", s.batch},
            {"crop", s.crop},
            {"learning_rate", s.learning_rate},
            {"steps", s.steps},
            {"seed", s.seed}};
}

TrainingSettings with_defaults(TrainingSettings s) {
    using Multipliers = std::vector<int64_t>;
    if (s.multipliers.empty())
        s.multipliers = s.kind == ModelConfig::Kind::regression ? Multipliers{1, 2, 4, 4} : Multipliers{1, 2, 2};
    return s;
}

void check(const std::vector<TrainingPair>& pairs, const TrainingSettings& s) {
    const auto require = [](bool ok, const char* option, auto got, const char* expected) {
        if (!ok) throw usage_error(option, fmt::format("is not valid (got {}, expected {})", got, expected));
    };
    const bool diffusion = s.kind == ModelConfig::Kind::diffusion;
    const int unit = (1 << (s.multipliers.size() - 1)) * (diffusion ? fold : 1);
    require(s.channels >= 8 && s.channels <= 256 && s.channels % (diffusion ? 16 : 8) == 0, "--channels", s.channels,
            diffusion ? "a multiple of 16 up to 256" : "a multiple of 8 up to 256");
    require(s.batch >= 1 && s.batch <= 256, "--batch", s.batch, "1 to 256");
    require(s.crop >= unit && s.crop <= 1024 && s.crop % unit == 0, "--crop", s.crop,
            "up to 1024 pixels, a multiple of what the network halves, 16 at most by default");
    require(s.steps >= 1 && s.steps <= 100'000'000, "--steps", s.steps, "1 to 100000000");
    require(s.learning_rate > 0 && s.learning_rate <= 1, "--learning-rate", s.learning_rate, "above 0, up to 1");
    if (pairs.empty()) throw input_error("learn train", "there are no pairs to learn from");
    for (const TrainingPair& p : pairs) {
        const auto same = [&](const auto& image) {
            return image.width == p.background.width && image.height == p.background.height;
        };
        if (!same(p.coverage) || !same(p.layer) || !same(p.rainy) || p.background.width < s.crop ||
            p.background.height < s.crop)
            throw input_error(
                "learn train",
                fmt::format("a pair's pictures differ in size or are smaller than a crop of {} pixels", s.crop));
    }
}

int64_t head_width(int64_t channels) {
    return std::gcd(int64_t(32), channels);
}

ModelConfig config_of(const TrainingSettings& s) {
    ModelConfig c;
    c.kind = s.kind;
    c.unet = {.in_channels = regression_channels,
              .channels = s.channels,
              .multipliers = s.multipliers,
              .res_blocks = 1,
              .attention_factors = {},
              .head_width = head_width(s.channels * s.multipliers.back())};
    if (s.kind == ModelConfig::Kind::regression) return c;
    c.fold = fold;
    c.tells_velocity = true;
    const int64_t cell = 3 * fold * fold;
    c.unet.in_channels = cell + regression_channels * fold * fold;
    c.unet.out_channels = cell;
    c.unet.attention_factors = {int64_t(1) << (s.multipliers.size() - 1)};
    c.unet.head_width = head_width(s.channels / 2 * s.multipliers.back());
    c.guide = c.unet;
    c.guide->channels = s.channels / 2;
    c.unet.context_channels = cell;
    return c;
}

}  // namespace

struct Trainer::State {
    TrainingSettings settings;
    ModelConfig config;
    TrainingPictures pictures;
    std::optional<UNet> unet, guide;
    std::optional<Adam> adam;
    std::vector<at::Tensor> losses;  // that nobody has read yet
    int step = 0;

    State(const std::vector<TrainingPair>& pairs, const TrainingSettings& s)
        : settings(with_defaults(s)),
          config((check(pairs, settings), config_of(settings))),
          pictures(pairs, device_named(s.device)) {
        NamedTensors weights;
        unet = fresh_network(config.unet, unet_prefix, s.seed, weights);
        if (config.guide) guide = fresh_network(*config.guide, guide_prefix, s.seed + 1, weights);
        adam.emplace(std::move(weights));
    }

    /// Its weights are added, under the names that they have in a model.
    UNet fresh_network(const UNetConfig& network, const char* prefix, uint64_t seed, NamedTensors& weights) const {
        const at::Device device = device_named(settings.device);
        const Parameters fresh([source = fresh_parameters(seed), device](const std::string& name,
                                                                         const TensorShape& shape, const Start& start) {
            return source.get(name, shape, start).to(device).set_requires_grad(true);
        });
        NamedTensors own;
        UNet made(recorded_parameters(fresh, own), network);
        for (auto& [name, tensor] : own) weights.emplace_back(prefix + name, tensor);
        return made;
    }

    double learning_rate() const {
        const double rise = std::min(1.0, (step + 1.0) / warm_up), done = double(step) / settings.steps;
        return settings.learning_rate * rise * 0.5 * (1 + std::cos(std::numbers::pi * done));
    }

    at::Tensor loss(const Crops& crops) const {
        return guide ? diffusion_loss(*unet, *guide, config, crops, settings.seed, step)
                     : regression_loss(*unet, crops);
    }
};

namespace {

/// Written tensors must outlive the call, so they are kept here.
void write_tensors(const std::string& path, const std::map<std::string, std::string>& metadata,
                   const NamedTensors& tensors, TensorType type) {
    std::vector<at::Tensor> kept;
    std::vector<WrittenTensor> written;
    for (const auto& [name, tensor] : tensors) {
        kept.push_back(tensor.to(at::kCPU).contiguous());
        written.push_back({name, tensor.sizes().vec(), {kept.back().data_ptr<float>(), size_t(kept.back().numel())}});
    }
    write_safetensors(path, metadata, written, type);
}

void copy_stored(SafetensorsFile& file, const std::string& name, at::Tensor& tensor) {
    const c10::NoGradGuard no_gradients;
    const auto found = file.entries().find(name);
    if (found == file.entries().end() || found->second.shape != tensor.sizes().vec())
        throw input_error(file.path(),
                          fmt::format("has no tensor \"{}\" of shape {}", name, shape_text(tensor.sizes().vec())));
    at::Tensor values = at::empty(tensor.sizes(), at::kFloat);
    file.read(name, {values.data_ptr<float>(), size_t(values.numel())});
    tensor.copy_(values);
}

}  // namespace

Trainer::Trainer(const std::vector<TrainingPair>& pairs, const TrainingSettings& settings)
    : state_(std::make_unique<State>(pairs, settings)) {}
Trainer::~Trainer() = default;

void Trainer::start_from(const std::string& model) {
    SafetensorsFile file(model);
    for (auto& [name, tensor] : state_->adam->groups()) {
        const size_t dot = name.find('.');
        const std::string group = name.substr(0, dot);
        if (group == "weight" || group == "mean") copy_stored(file, name.substr(dot + 1), tensor);
    }
}

int Trainer::step() const {
    return state_->step;
}

void Trainer::train_step() {
    State& s = *state_;
    const at::Tensor loss = s.loss(s.pictures.take(s.settings, s.step));
    loss.backward();
    s.losses.push_back(loss.detach());
    s.adam->update(s.learning_rate(), s.step);
    ++s.step;
}

std::vector<double> Trainer::take_losses() {
    std::vector<at::Tensor>& pending = state_->losses;
    if (pending.empty()) return {};
    const at::Tensor all = at::stack(pending).to(at::kCPU).to(at::kDouble);
    const std::vector<double> values(all.data_ptr<double>(), all.data_ptr<double>() + all.numel());
    const int first = state_->step - int(pending.size());
    pending.clear();
    for (size_t i = 0; i < values.size(); ++i)
        if (!std::isfinite(values[i]))
            throw Error(ExitCode::render_failed, "learn train",
                        fmt::format("the loss is not finite at step {}", first + int(i)));
    return values;
}

void Trainer::save(const std::string& path) const {
    write_tensors(path, {{"step", std::to_string(state_->step)}, {"settings", to_json(state_->settings).dump()}},
                  state_->adam->groups(), TensorType::f32);
}

void Trainer::load(const std::string& path) {
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
    for (auto& [name, tensor] : state_->adam->groups()) copy_stored(file, name, tensor);
    state_->step = std::stoi(step);
}

void Trainer::save_model(const std::string& path, const std::string& note) const {
    NamedTensors model;
    const Adam& adam = *state_->adam;
    for (size_t i = 0; i < adam.weights().size(); ++i) model.emplace_back(adam.weights()[i].first, adam.mean()[i]);
    auto metadata = model_metadata(state_->config);
    metadata["training"] = note;
    write_tensors(path, metadata, model, TensorType::f16);
}

}  // namespace pluvia
