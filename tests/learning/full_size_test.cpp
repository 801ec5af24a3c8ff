// The networks with their published widths. Slow: a tile takes minutes of two cores.
#include "tools/learning/rain_model.h"
#include "tools/learning/synthesis.h"

#include <doctest/doctest.h>
#include <sys/resource.h>

using namespace pluvia;

namespace {

/// Of this process, at any time until now.
double peak_memory_gib() {
    rusage usage = {};
    getrusage(RUSAGE_SELF, &usage);
    return double(usage.ru_maxrss) / (1 << 20);
}

}  // namespace

TEST_CASE("a tile of 512 pixels of the networks as published takes at most 2.5 GiB" * doctest::skip()) {
    const c10::NoGradGuard no_gradients;
    set_learning_threads(0);
    RainModel model;
    model.config.first_stage = FirstStageConfig();
    model.unet.emplace(fresh_parameters(1), model.config.unet);
    model.first_stage.emplace(fresh_parameters(2), *model.config.first_stage);
    MESSAGE("networks alone: ", peak_memory_gib(), " GiB");
    CHECK(peak_memory_gib() > 1.2);  // the weights are there
    // What happens to a tile, in the order of cost, so that a run that is cut short has seen the most.
    const at::Tensor latent = fresh_parameters(3).get("latent", {1, 3, 128, 128}, {Start::uniform});
    const at::Tensor picture = model.first_stage->decode(latent);
    MESSAGE("with the latent decoded: ", peak_memory_gib(), " GiB");
    CHECK(model.first_stage->encode(picture).sizes() == latent.sizes());
    MESSAGE("with the picture encoded: ", peak_memory_gib(), " GiB");
    CHECK((*model.unet)(at::cat({latent, latent}, 1), at::full({1}, 500.0f)).sizes() == latent.sizes());
    MESSAGE("with noise predicted: ", peak_memory_gib(), " GiB");
    CHECK(peak_memory_gib() <= 2.5);
}
