// LPIPS and FID against values that plain PyTorch computed with the same random weights; scores_fixture.py makes them.
#include "renderer/core/error.h"
#include "tests/learning/small_models.h"
#include "tests/learning/stored_tensor.h"
#include "tests/temporary_folder.h"
#include "tools/learning/inception.h"
#include "tools/learning/lpips.h"
#include "tools/learning/trained_scores.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <cmath>

using namespace pluvia;

namespace {

SafetensorsFile& fixture() {
    static SafetensorsFile file = open_fixture("scores");
    return file;
}

at::Tensor stored(const std::string& name) {
    return stored_tensor(fixture(), name);
}

TensorShapes stored_shapes(const std::string& network) {
    return nlohmann::json::parse(fixture().metadata().at(network)).get<TensorShapes>();
}

/// Kernels of a size that keeps signals alive through many layers.
Parameters lively_parameters(uint64_t seed) {
    return Parameters(
        [fresh = fresh_parameters(seed, true)](const std::string& name, const TensorShape& shape, const Start& start) {
            const at::Tensor t = fresh.get(name, shape, start);
            return shape.size() == 4 ? t * std::sqrt(6.0) : t;
        });
}

TensorShapes shapes_of(const NamedTensors& tensors) {
    TensorShapes shapes;
    for (const auto& [name, tensor] : tensors) shapes[name] = tensor.sizes().vec();
    return shapes;
}

void write_tensors(const std::string& path, const NamedTensors& tensors) {
    std::vector<at::Tensor> kept;
    std::vector<WrittenTensor> written;
    for (const auto& [name, tensor] : tensors) {
        kept.push_back(tensor.contiguous());
        written.push_back({name, tensor.sizes().vec(), {kept.back().data_ptr<float>(), size_t(kept.back().numel())}});
    }
    write_safetensors(path, {}, written);
}

Image<Rgb> image_of(const at::Tensor& t) {
    Image<Rgb> image(int(t.size(3)), int(t.size(2)));
    const auto value = t.accessor<float, 4>();
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            image.at(x, y) = {value[0][0][y][x], value[0][1][y][x], value[0][2][y][x]};
    return image;
}

}  // namespace

TEST_CASE("LPIPS by AlexNet and VGG16 is what plain PyTorch finds, and 0 for equal pictures") {
    const c10::NoGradGuard no_gradients;
    const TemporaryFolder folder;
    for (const auto& [network, name] : {std::pair{LpipsNetwork::alex, "alex"}, {LpipsNetwork::vgg, "vgg"}}) {
        CAPTURE(name);
        NamedTensors tensors;
        const Lpips lpips(recorded_parameters(lively_parameters(23), tensors), network);
        CHECK(shapes_of(tensors) == stored_shapes(name));
        const double expected = stored(name).item<double>();
        // Means of thousands of float terms: a few 1e-7 of the largest, which is near 0.1.
        CHECK(std::abs(lpips(stored("a"), stored("b")) - expected) < 1e-6);
        CHECK(std::abs(expected) > 1e-3);
        CHECK(lpips(stored("a"), stored("a")) == 0);
        // The same by file and pictures; shapes tell which network it is.
        write_tensors(folder / name, tensors);
        const LpipsScore score(folder / name);
        CHECK(std::string(score.network()) == (network == LpipsNetwork::alex ? "AlexNet" : "VGG16"));
        CHECK(std::abs(score(image_of(stored("a")), image_of(stored("b"))) - expected) < 1e-6);
        CHECK_THROWS_AS(score(Image<Rgb>(31, 64), Image<Rgb>(31, 64)), Error);
    }
}

TEST_CASE("FID's features are those of plain PyTorch, by 21.8 million values of pytorch-fid's names") {
    const c10::NoGradGuard no_gradients;
    NamedTensors tensors;
    Inception inception(recorded_parameters(lively_parameters(29), tensors));
    const at::Tensor a = inception(stored("a")), b = inception(stored("b"));
    REQUIRE(a.sizes() == at::IntArrayRef({inception_features}));
    // Features are about 1; rounding grows through 20 layers to some 1e-5.
    CHECK((a - stored("inception.a")).abs().max().item<double>() < 1e-4);
    CHECK((b - stored("inception.b")).abs().max().item<double>() < 1e-4);
    CHECK((a - b).abs().mean().item<double>() > 0.1);  // so that the comparison sees the whole network
    CHECK(shapes_of(tensors) == stored_shapes("inception"));
    int64_t learnt = 0;
    for (const auto& [name, shape] : shapes_of(tensors))
        if (name.find("running_") == std::string::npos) learnt += element_count(shape);
    CHECK(learnt == 21'785'568);  // torchvision's Inception-v3 without its two classifiers

    const TemporaryFolder folder;
    write_tensors(folder / "inception", tensors);
    FidScore fid(folder / "inception");
    fid.add(image_of(stored("a")), image_of(stored("b")));
    CHECK_THROWS_AS(fid.distance(), Error);  // of one picture
    fid.add(image_of(stored("b")), image_of(stored("a")));
    CHECK(std::abs(fid.distance()) < 1e-6);  // the same two pictures on both sides
    CHECK_THROWS_AS(LpipsScore(folder / "inception"), Error);
}

TEST_CASE("the Frechet distance of normal sets is that of the closed form") {
    // Sets with the exact mean 0 and variances v: two points for each axis.
    const auto set = [](std::vector<double> variances, double shift) {
        std::vector<std::vector<double>> vectors;
        const double n = 2 * double(variances.size());
        for (size_t axis = 0; axis < variances.size(); ++axis)
            for (const double sign : {-1.0, 1.0}) {
                std::vector<double> v(variances.size(), shift);
                v[axis] += sign * std::sqrt(variances[axis] * (n - 1) / 2);
                vectors.push_back(v);
            }
        return vectors;
    };
    // |shift|^2 + sum (sqrt(v) - sqrt(w))^2: 3 * 4 + (1 - 2)^2 + (2 - 3)^2 + 0.
    CHECK(frechet_distance(set({1, 4, 9}, 0), set({4, 9, 9}, 2)) == doctest::Approx(14).epsilon(1e-9));
    // Fewer vectors than dimensions: equal sets are at distance 0, where a root of the product would fail.
    const std::vector<std::vector<double>> few = {{1, 2, 3, 4, 5}, {2, 1, 0, 7, 1}};
    CHECK(std::abs(frechet_distance(few, few)) < 1e-9);
    // Two vectors each, differences (d) and (e): traces d^2 / 2 + e^2 / 2 - |d . e|, means apart.
    const std::vector<std::vector<double>> a = {{0, 0, 0}, {2, 0, 0}}, b = {{0, 0, 0}, {0, 4, 0}};
    CHECK(frechet_distance(a, b) == doctest::Approx(1 + 4 + 2 + 8 - 0).epsilon(1e-9).scale(0));
}
