// Networks against answers of plain PyTorch on the same weights; parity_fixture.py makes them.
#include "renderer/core/error.h"
#include "tests/learning/stored_tensor.h"
#include "tools/learning/first_stage.h"
#include "tools/learning/schedule.h"
#include "tools/learning/unet.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace pluvia;

namespace {

// Float sums of up to 3456 products of order one, in another order: a few 1e-6. The demanded limit is 1e-4.
constexpr double tolerance = 1e-4;

SafetensorsFile& fixture() {
    static SafetensorsFile file = open_fixture("parity");
    return file;
}

at::Tensor stored(const std::string& name) {
    return stored_tensor(fixture(), name);
}

double largest_difference(const at::Tensor& a, const at::Tensor& b) {
    REQUIRE(a.sizes() == b.sizes());
    return (a - b).abs().max().item<double>();
}

TensorShapes stored_shapes(const std::string& network) {
    return nlohmann::json::parse(fixture().metadata().at(network)).get<TensorShapes>();
}

UNetConfig small_unet(int64_t context_channels) {
    return {
        .channels = 32, .multipliers = {1, 2, 3}, .attention_factors = {2, 4}, .context_channels = context_channels};
}

FirstStageConfig small_first_stage() {
    return {.channels = 32, .codes = 64};
}

template <class Network, class Config>
TensorShapes shapes_of(const Config& config) {
    TensorShapes list;
    Network(listed_parameters(list), config);
    return list;
}

int64_t values_in(const TensorShapes& shapes) {
    int64_t n = 0;
    for (const auto& [name, shape] : shapes) n += element_count(shape);
    return n;
}

}  // namespace

TEST_CASE("the UNet answers as plain PyTorch does") {
    const at::NoGradGuard no_gradients;
    const UNet unet(fresh_parameters(11, true), small_unet(0));
    const double difference = largest_difference(unet(stored("unet.x"), stored("unet.time")), stored("unet.y"));
    MESSAGE("largest difference ", difference);
    CHECK(difference < tolerance);
    CHECK(stored("unet.y").abs().max().item<double>() > 0.1);
}

TEST_CASE("the UNet with a guide answers as plain PyTorch does") {
    const at::NoGradGuard no_gradients;
    const UNet unet(fresh_parameters(11, true), small_unet(3));
    const at::Tensor y = unet(stored("guided.x"), stored("guided.time"), stored("guided.context"));
    const double difference = largest_difference(y, stored("guided.y"));
    MESSAGE("largest difference ", difference);
    CHECK(difference < tolerance);
}

TEST_CASE("another guide makes another answer") {
    const at::NoGradGuard no_gradients;
    const UNet unet(fresh_parameters(11, true), small_unet(3));
    const at::Tensor context = stored("guided.context");
    const at::Tensor y = unet(stored("guided.x"), stored("guided.time"), context.flip({2}));
    CHECK(largest_difference(y, stored("guided.y")) > 10 * tolerance);
}

TEST_CASE("the first stage answers as plain PyTorch does") {
    const at::NoGradGuard no_gradients;
    const FirstStage stage(fresh_parameters(13, true), small_first_stage());
    CHECK(largest_difference(stage.encode(stored("first_stage.x")), stored("first_stage.z")) < tolerance);
    CHECK(largest_difference(stage.decode(stored("first_stage.latent")), stored("first_stage.y")) < tolerance);
}

TEST_CASE("gradients flow through the networks and swish keeps what they need") {
    const UNet unet(fresh_parameters(11, true), small_unet(3));
    at::Tensor x = stored("guided.x").clone();
    x.set_requires_grad(true);
    const at::Tensor y = unet(x, stored("guided.time"), stored("guided.context"));
    y.square().sum().backward();
    CHECK(largest_difference(y.detach(), stored("guided.y")) < tolerance);
    CHECK(x.grad().abs().max().item<double>() > 0);
}

TEST_CASE("steps of DDIM are those of the formula") {
    const auto alphas = alphas_cumprod({});
    const at::Tensor known = stored("ddim.alphas");
    CHECK(alphas[0] == doctest::Approx(known[0].item<double>()).epsilon(1e-6).scale(0));
    CHECK(alphas[500] == doctest::Approx(known[1].item<double>()).epsilon(1e-6).scale(0));
    CHECK(alphas[999] == doctest::Approx(known[2].item<double>()).epsilon(1e-5).scale(0));
    const auto next = [](const DdimStep& s) {
        return s.x_factor() * stored("ddim.x") + s.eps_factor() * stored("ddim.eps") + s.sigma * stored("ddim.noise");
    };
    const auto steps = ddim_steps({}, 20, 1);
    REQUIRE(steps.size() == 20);
    CHECK(steps.front().time == 951);
    CHECK(steps.back().time == 1);
    CHECK(largest_difference(next(steps.front()), stored("ddim.first")) < tolerance);
    CHECK(largest_difference(next(ddim_steps({}, 20, 0.5).back()), stored("ddim.last")) < tolerance);
}

TEST_CASE("keys and shapes of small networks are those of the description") {
    CHECK(shapes_of<UNet>(small_unet(0)) == stored_shapes("unet"));
    CHECK(shapes_of<UNet>(small_unet(3)) == stored_shapes("guided"));
    CHECK(shapes_of<FirstStage>(small_first_stage()) == stored_shapes("first_stage"));
}

TEST_CASE("the networks as published have the published number of tensors and values") {
    const TensorShapes unet = shapes_of<UNet>(UNetConfig());
    CHECK(unet.size() == 368);
    CHECK(values_in(unet) == 274'062'211);
    CHECK(unet.at("input_blocks.4.1.qkv.weight") == TensorShape{1344, 448, 1});
    CHECK(unet.at("output_blocks.8.2.conv.weight") == TensorShape{448, 448, 3, 3});
    CHECK(unet.count("output_blocks.9.1.norm.weight") == 0);
    CHECK(unet.count("input_blocks.1.1.norm.weight") == 0);
    const TensorShapes stage = shapes_of<FirstStage>(FirstStageConfig());
    CHECK(stage.size() == 205);
    CHECK(values_in(stage) == 55'322'782);
    CHECK(std::count_if(stage.begin(), stage.end(), [](const auto& s) { return s.first.starts_with("encoder."); }) ==
          88);
    CHECK(std::count_if(stage.begin(), stage.end(), [](const auto& s) { return s.first.starts_with("decoder."); }) ==
          112);
}

TEST_CASE("shapes alone tell how a network was built") {
    const TensorShapes unet = shapes_of<UNet>(UNetConfig());
    CHECK(shapes_of<UNet>(unet_config(unet, 32, "test")) == unet);
    CHECK(unet_config(unet, 32, "test").attention_factors == std::vector<int64_t>{2, 4, 8});
    CHECK(unet_config(unet, 32, "test").context_channels == 0);
    const TensorShapes guided = shapes_of<UNet>(small_unet(3));
    CHECK(shapes_of<UNet>(unet_config(guided, 32, "test")) == guided);
    const TensorShapes stage = shapes_of<FirstStage>(FirstStageConfig());
    CHECK(shapes_of<FirstStage>(first_stage_config(stage, "test")) == stage);
    TensorShapes broken = unet;
    broken.erase("out.2.weight");
    CHECK_THROWS_AS(unet_config(broken, 32, "test"), Error);
}
