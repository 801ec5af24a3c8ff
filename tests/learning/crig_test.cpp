// CRIGNet against pictures that plain PyTorch made of the same weights; crig_fixture.py makes them.
#include "tools/learning/crig.h"
#include "renderer/core/error.h"
#include "tests/learning/small_models.h"
#include "tests/learning/stored_tensor.h"
#include "tests/temporary_folder.h"
#include "tools/learning/crig_pictures.h"
#include "tools/learning/synthesis.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace pluvia;

namespace {

constexpr double tolerance = 1e-4;  // of values that reach 2; the demanded limit

SafetensorsFile& fixture() {
    static SafetensorsFile file = open_fixture("crig");
    return file;
}

at::Tensor stored(const std::string& name) {
    return stored_tensor(fixture(), name);
}

constexpr CrigConfig small = {.latent = 6, .channels = 8};

/// Every fifth row and seventh column, as the fixture has them.
at::Tensor thinned(const at::Tensor& picture) {
    return picture.slice(2, 0, crig_side, 5).slice(3, 0, crig_side, 7);
}

double difference(const std::string& name, int norm_steps, CrigMode mode, bool noisy) {
    const c10::NoGradGuard no_gradients;
    CrigNet network(fresh_parameters(17, true), small);
    for (int i = 0; i < norm_steps; ++i) network.iterate_norms();
    int asked = 0;
    const auto noise = [&](int64_t height, int64_t width) {
        if (!noisy) return at::Tensor();
        return fresh_parameters(17, true).get("noise." + std::to_string(asked++), {1, 1, height, width},
                                              {Start::uniform});
    };
    const at::Tensor picture = network(stored("input"), mode, noise);
    REQUIRE(picture.sizes() == at::IntArrayRef({1, 3, crig_side, crig_side}));
    CHECK(asked == (noisy ? 6 : 0));
    return (thinned(picture) - stored(name)).abs().max().item<double>();
}

TensorShapes shapes_of(const CrigConfig& config) {
    TensorShapes list;
    CrigNet(listed_parameters(list), config);
    return list;
}

void write_crig_model(const std::string& path, const CrigConfig& config) {
    NamedTensors tensors;
    add_network<CrigNet>(tensors, crig_prefix, config, 17);
    std::vector<WrittenTensor> written;
    for (const auto& [name, t] : tensors)
        written.push_back({name, t.sizes().vec(), {t.data_ptr<float>(), size_t(t.numel())}});
    write_safetensors(path, {}, written);
}

bool same_bytes(const Image<Rgba8>& a, const Image<Rgba8>& b) {
    return a.pixels == b.pixels;
}

}  // namespace

TEST_CASE("CRIGNet draws what plain PyTorch draws: as published, with stored statistics, and without noise") {
    CHECK(difference("training", 1, CrigMode::training, true) < tolerance);
    CHECK(difference("evaluation", 20, CrigMode::evaluation, true) < tolerance / 10);  // values reach a tenth
    CHECK(difference("quiet", 2, CrigMode::training, false) < tolerance);
    CHECK(difference("training", 1, CrigMode::training, false) > 10 * tolerance);
}

TEST_CASE("keys and shapes of CRIGNet are those of the description, and 25.0 million values are learnt") {
    CHECK(shapes_of(small) == nlohmann::json::parse(fixture().metadata().at("keys")).get<TensorShapes>());
    int64_t learnt = 0;
    for (const auto& [name, shape] : shapes_of({}))
        if (name.find("running_") == std::string::npos && !name.ends_with("weight_u") && !name.ends_with("weight_v"))
            learnt += element_count(shape);
    MESSAGE("values: ", learnt);
    CHECK(double(learnt) == doctest::Approx(25.0e6).epsilon(0.002));  // as measured on the original, to three digits
    CHECK(shapes_of({}).at("init.init.0.weight_orig") == TensorShape{130, 2048, 4, 4});
}

TEST_CASE("a seed draws the labels and latents that the published script draws") {
    const TemporaryFolder folder;
    write_crig_model(folder / "model", small);
    CrigSettings s;
    s.noise = false;
    CrigPictures pictures(folder / "model", s);
    const CrigLabel label = pictures.next().label;
    CHECK(label.intensity == doctest::Approx(stored("seed.label")[0][0].item<double>()).epsilon(1e-6).scale(0));
    CHECK(label.wind == doctest::Approx(stored("seed.label")[0][1].item<double>()).epsilon(1e-6).scale(0));
    at::manual_seed(123);
    at::rand({1, 2});
    CHECK((at::randn({1, 128}) - stored("seed.latent")).abs().max().item<double>() < 1e-6);
}

TEST_CASE("a picture of CRIGNet depends on seed and place only, and each quirk changes it") {
    const TemporaryFolder folder;
    write_crig_model(folder / "model", small);
    set_learning_threads(1);
    const auto third = [&](const CrigSettings& s, bool skip) {
        CrigPictures pictures(folder / "model", s);
        for (int i = 0; i < 2; ++i) skip ? void(pictures.skip()) : void(pictures.next());
        return pictures.next().image;
    };
    CrigSettings s;
    s.label = crig_label(50, -0.3);
    const auto picture = third(s, false);
    CHECK(same_bytes(picture, third(s, true)));
    const auto differs = [&](auto change) {
        CrigSettings other = s;
        change(other);
        return !same_bytes(picture, third(other, true));
    };
    CHECK(differs([](CrigSettings& o) { o.seed = 7; }));
    CHECK(differs([](CrigSettings& o) { o.label = crig_label(100, -0.3); }));
    CHECK(differs([](CrigSettings& o) { o.label = crig_label(50, 0.3); }));
    CHECK(differs([](CrigSettings& o) { o.one_latent = true; }));
    CHECK(differs([](CrigSettings& o) { o.evaluation = true; }));
    CHECK(differs([](CrigSettings& o) { o.noise = false; }));
    CHECK(differs([](CrigSettings& o) { o.rounded = true; }));
}

TEST_CASE("labels are CRIGNet's, and what is no CRIGNet of 256 pixels is refused") {
    CHECK(crig_label(0, 1).intensity == -1);
    CHECK(crig_label(100, 1).intensity == 1);
    CHECK_THROWS_AS(crig_label(101, 0), Error);
    CHECK_THROWS_AS(crig_label(50, 1.5), Error);
    const TemporaryFolder folder;
    write_diffusion_model(folder / "diffusion", false, 0);
    CHECK_THROWS_AS(CrigPictures(folder / "diffusion", {}), Error);
    write_crig_model(folder / "crig", small);
    CHECK(crig_config(SafetensorsFile(folder / "crig")).latent == 6);
    CHECK(crig_config(SafetensorsFile(folder / "crig")).channels == 8);
}
