#include "tools/learning/rain_model.h"

#include "renderer/core/error.h"
#include "tools/learning/synthesis.h"

#include <fmt/format.h>

#include <ATen/Parallel.h>
#include <malloc.h>
#include <ctime>
#include <thread>

namespace pluvia {

at::Device device_named(const std::string& name) {
    if (name == "cpu") return at::kCPU;
    if (name != "cuda")
        throw usage_error("--device", fmt::format("is not valid (got \"{}\", expected cpu or cuda)", name));
    if (!at::hasCUDA()) throw usage_error("--device", "cuda cannot be used: this libtorch or machine has none");
    return at::kCUDA;
}

at::Tensor seen_coverage(const at::Tensor& coverage) {
    return (coverage * 16).clamp_max(1);
}

at::Tensor guide_tokens(const at::Tensor& cells) {
    constexpr int64_t side = 16;
    return at::adaptive_avg_pool2d(cells, {side, side}).flatten(2).transpose(1, 2);
}

/// Of this process, for good. Layers as large as a tile come and go with every step: to have their pages made anew each
/// time costs as much as the network does (29 s instead of 17.5 for 2048x1024 pixels on two cores), to keep them half a
/// GiB. Networks with a first stage have layers of which that would be too much.
static void keep_freed_memory() {
    mallopt(M_MMAP_THRESHOLD, 1 << 28);
    mallopt(M_TRIM_THRESHOLD, 1 << 30);
}

std::shared_ptr<const RainModel> load_model(const std::string& path, const std::string& device) {
    const c10::NoGradGuard no_gradients;
    const auto model = std::make_shared<RainModel>();
    model->device = device_named(device);
    const auto file = std::make_shared<SafetensorsFile>(path);
    model->config = model_config(*file);
    const auto stored = [&](const char* prefix) { return stored_parameters(file, prefix, model->device); };
    model->unet.emplace(stored(unet_prefix), model->config.unet);
    if (model->config.first_stage)
        model->first_stage.emplace(stored(first_stage_prefix), *model->config.first_stage);
    else
        keep_freed_memory();
    if (model->config.guide) model->guide.emplace(stored(guide_prefix), *model->config.guide);
    return model;
}

const ModelConfig& config_of(const RainModel& model) {
    return model.config;
}

void set_learning_threads(int threads) {
    at::set_num_threads(threads > 0 ? threads : int(std::max(1u, std::thread::hardware_concurrency())));
}

std::string slow_blas_notice() {
    constexpr int64_t n = 256;
    constexpr double slow = 4e9;  // operations/s of one core; reference BLAS stays below 3e9, OpenBLAS above 20e9
    const c10::NoGradGuard no_gradients;
    const at::Tensor a = at::full({n, n}, 0.5f);
    at::mm(a, a);  // pages and threads are there from here on
    const auto processor_seconds = [] {
        timespec t;
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
        return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
    };
    const double start = processor_seconds();
    for (int i = 0; i < 3; ++i) at::mm(a, a);
    const double rate = 3 * 2.0 * n * n * n / (processor_seconds() - start);
    if (rate > slow) return "";
    return fmt::format(
        "matrix products run at {:.1f} GFLOP/s, as the reference BLAS has them; apt-get install "
        "libopenblas0-pthread makes attention several times faster",
        rate * 1e-9);
}

}  // namespace pluvia
