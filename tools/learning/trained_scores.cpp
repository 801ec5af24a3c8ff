#include "tools/learning/trained_scores.h"

#include "renderer/core/error.h"
#include "tools/learning/inception.h"
#include "tools/learning/lpips.h"

#include <fmt/format.h>

namespace pluvia {
namespace {

constexpr int smallest_side = 32;

/// [1, 3, height, width].
at::Tensor tensor_of(const Image<Rgb>& image) {
    at::Tensor t = at::empty({image.height, image.width, 3}, at::kFloat);
    float* values = t.data_ptr<float>();
    for (size_t i = 0; i < image.pixels.size(); ++i) {
        const Rgb p = image.pixels[i];
        values[3 * i] = p.r, values[3 * i + 1] = p.g, values[3 * i + 2] = p.b;
    }
    return t.permute({2, 0, 1}).unsqueeze(0).contiguous();
}

LpipsNetwork network_in(const SafetensorsFile& file) {
    const auto found = file.entries().find("features.0.weight");
    if (found == file.entries().end())
        throw input_error(file.path(), "holds no network of LPIPS: it has no tensor \"features.0.weight\"");
    return found->second.shape == TensorShape{64, 3, 11, 11} ? LpipsNetwork::alex : LpipsNetwork::vgg;
}

at::Tensor rows_of(const std::vector<std::vector<double>>& vectors) {
    at::Tensor rows = at::empty({int64_t(vectors.size()), int64_t(vectors.front().size())}, at::kDouble);
    for (size_t i = 0; i < vectors.size(); ++i)
        std::copy(vectors[i].begin(), vectors[i].end(), rows.data_ptr<double>() + i * vectors[i].size());
    return rows;
}

std::vector<double> features_of(Inception& inception, const Image<Rgb>& picture) {
    const at::Tensor f = inception(tensor_of(picture)).to(at::kDouble).contiguous();
    return {f.data_ptr<double>(), f.data_ptr<double>() + f.numel()};
}

}  // namespace

struct LpipsScore::State {
    LpipsNetwork network;
    Lpips lpips;
};

LpipsScore::LpipsScore(const std::string& path) {
    const c10::NoGradGuard no_gradients;
    const auto file = std::make_shared<SafetensorsFile>(path);
    const LpipsNetwork network = network_in(*file);
    state_.reset(new State{network, Lpips(stored_parameters(file, "", at::kCPU), network)});
}
LpipsScore::~LpipsScore() = default;

double LpipsScore::operator()(const Image<Rgb>& a, const Image<Rgb>& b) const {
    if (std::min(a.width, a.height) < smallest_side)
        throw input_error("LPIPS", fmt::format("needs larger pictures (got {}x{}, expected sides from {} on)", a.width,
                                               a.height, smallest_side));
    const c10::NoGradGuard no_gradients;
    return state_->lpips(tensor_of(a), tensor_of(b));
}

const char* LpipsScore::network() const {
    return state_->network == LpipsNetwork::alex ? "AlexNet" : "VGG16";
}

struct FidScore::State {
    Inception inception;
    std::vector<std::vector<double>> predictions, truths;
};

FidScore::FidScore(const std::string& path) {
    const auto file = std::make_shared<SafetensorsFile>(path);
    for (const char* name : {"Conv2d_1a_3x3.conv.weight", "Mixed_7c.branch_pool.conv.weight"})
        if (!file->has(name))
            throw input_error(path, fmt::format("holds no Inception network of FID: it has no tensor \"{}\"", name));
    state_.reset(new State{Inception(stored_parameters(file, "", at::kCPU)), {}, {}});
}
FidScore::~FidScore() = default;

void FidScore::add(const Image<Rgb>& prediction, const Image<Rgb>& truth) {
    const c10::NoGradGuard no_gradients;
    state_->predictions.push_back(features_of(state_->inception, prediction));
    state_->truths.push_back(features_of(state_->inception, truth));
}

double FidScore::distance() const {
    if (state_->truths.size() < 2)
        throw input_error("FID", fmt::format("needs at least two pictures (got {})", state_->truths.size()));
    return frechet_distance(state_->predictions, state_->truths);
}

double frechet_distance(const std::vector<std::vector<double>>& a, const std::vector<std::vector<double>>& b) {
    const c10::NoGradGuard no_gradients;
    const at::Tensor of_a = rows_of(a), of_b = rows_of(b), mean_a = of_a.mean(0), mean_b = of_b.mean(0);
    // Rows whose products are the covariances.
    const at::Tensor x = (of_a - mean_a) / std::sqrt(double(a.size()) - 1),
                     y = (of_b - mean_b) / std::sqrt(double(b.size()) - 1);
    // (A B)^(1/2) = (x^T x y^T y)^(1/2) has the singular values of x y^T as eigenvalues: exact also where there are
    // fewer pictures than features, where a root of the product itself is ill-conditioned.
    const double root = at::linalg_svdvals(at::mm(x, y.t())).sum().item<double>();
    return (mean_a - mean_b).square().sum().item<double>() + x.square().sum().item<double>() +
           y.square().sum().item<double>() - 2 * root;
}

}  // namespace pluvia
