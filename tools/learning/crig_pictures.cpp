#include "tools/learning/crig_pictures.h"

#include "renderer/core/error.h"
#include "tools/learning/crig.h"
#include "tools/learning/rain_model.h"

#include <algorithm>

namespace pluvia {
namespace {

uint8_t byte_of(float value, bool rounded) {
    return uint8_t(std::clamp(value, 0.0f, 1.0f) * 255 + (rounded ? 0.5f : 0.0f));
}

CrigNet stored_network(const std::string& path, at::Device device) {
    const auto file = std::make_shared<SafetensorsFile>(path);
    return CrigNet(stored_parameters(file, crig_prefix, device), crig_config(*file));
}

}  // namespace

struct CrigPictures::State {
    CrigSettings settings;
    at::Device device;
    CrigNet network;
    at::Tensor one_latent;  // undefined: each picture has its own

    /// What is random in a picture.
    struct Draws {
        at::Tensor input;
        CrigLabel label;
        std::vector<at::Tensor> noise;
    };

    /// The order is that of the published script, and so are the values: torch's generator of the processor.
    Draws draw() {
        Draws d;
        if (settings.label) {
            d.label = *settings.label;
        } else {
            const at::Tensor uniform = at::rand({1, crig_labels}) * 2 - 1;
            d.label = {uniform[0][0].item<float>(), uniform[0][1].item<float>()};
        }
        const at::Tensor latent = settings.one_latent ? one_latent : at::randn({1, network.config().latent});
        d.input = at::cat({latent, at::tensor({d.label.intensity, d.label.wind}).unsqueeze(0)}, 1).to(device);
        if (settings.noise)
            for (const int64_t side : {8, 8, 32, 32, 128, 128})
                d.noise.push_back(at::randn({1, 1, side, side}).to(device));
        if (!settings.evaluation) network.iterate_norms();
        return d;
    }
};

CrigPictures::CrigPictures(const std::string& path, const CrigSettings& settings, const std::string& device)
    : state_(new State{settings, device_named(device), stored_network(path, device_named(device)), {}}) {
    at::manual_seed(settings.seed);
    if (settings.one_latent) state_->one_latent = at::randn({1, state_->network.config().latent});
}
CrigPictures::~CrigPictures() = default;

CrigLabel CrigPictures::skip() {
    const c10::NoGradGuard no_gradients;
    return state_->draw().label;
}

CrigPicture CrigPictures::next() {
    const c10::NoGradGuard no_gradients;
    const State::Draws draws = state_->draw();
    size_t asked = 0;
    const auto noise = [&](int64_t, int64_t) { return draws.noise.empty() ? at::Tensor() : draws.noise[asked++]; };
    const at::Tensor drawn =
        state_->network(draws.input, state_->settings.evaluation ? CrigMode::evaluation : CrigMode::training, noise)
            .to(at::kCPU)
            .contiguous();
    if (!at::isfinite(drawn).all().item<bool>())
        throw Error(ExitCode::render_failed, "learn crig", "the network's answer is not finite");
    CrigPicture picture{draws.label, Image<Rgba8>(crig_side, crig_side)};
    const float* values = drawn.data_ptr<float>();
    const size_t plane = picture.image.pixels.size();
    for (size_t i = 0; i < plane; ++i) {
        const auto channel = [&](size_t c) { return byte_of(values[c * plane + i], state_->settings.rounded); };
        picture.image.pixels[i] = {channel(0), channel(1), channel(2), 255};
    }
    return picture;
}

}  // namespace pluvia
