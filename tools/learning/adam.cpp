#include "tools/learning/adam.h"

#include <algorithm>
#include <cmath>

namespace pluvia {
namespace {

constexpr double beta1 = 0.9, beta2 = 0.999, epsilon = 1e-8, weight_decay = 1e-4;
constexpr double mean_decay = 0.999;  // of the running mean of weights; it starts faster
constexpr double max_gradient = 1;    // length of all gradients together

}  // namespace

Adam::Adam(NamedTensors weights) : weights_(std::move(weights)) {
    for (const auto& [name, w] : weights_) {
        mean_.push_back(w.detach().clone());
        first_.push_back(at::zeros_like(w));
        second_.push_back(at::zeros_like(w));
    }
}

void Adam::update(double rate, int step) {
    const c10::NoGradGuard no_gradients;
    std::vector<at::Tensor> squares;
    for (const auto& [name, w] : weights_)
        if (w.grad().defined()) squares.push_back(w.grad().square().sum());
    if (squares.empty()) return;
    const at::Tensor length = at::stack(squares).sum().sqrt();
    const at::Tensor scale = (max_gradient / (length + 1e-12)).clamp_max(1);
    const double bias1 = 1 - std::pow(beta1, step + 1), bias2 = 1 - std::pow(beta2, step + 1);
    const double decay = std::min(mean_decay, (1.0 + step) / (10.0 + step));
    for (size_t i = 0; i < weights_.size(); ++i) {
        at::Tensor w = weights_[i].second;
        if (w.grad().defined()) {
            const at::Tensor gradient = w.grad() * scale;
            first_[i].mul_(beta1).add_(gradient, 1 - beta1);
            second_[i].mul_(beta2).addcmul_(gradient, gradient, 1 - beta2);
            w.mul_(1 - rate * weight_decay);
            w.addcdiv_(first_[i] / bias1, (second_[i] / bias2).sqrt() + epsilon, -rate);
            w.mutable_grad() = at::Tensor();
        }
        mean_[i].mul_(decay).add_(w.detach(), 1 - decay);
    }
}

NamedTensors Adam::groups() const {
    NamedTensors all;
    for (size_t i = 0; i < weights_.size(); ++i) {
        const std::string& name = weights_[i].first;
        all.insert(all.end(), {{"weight." + name, weights_[i].second.detach()},
                               {"mean." + name, mean_[i]},
                               {"first." + name, first_[i]},
                               {"second." + name, second_[i]}});
    }
    return all;
}

}  // namespace pluvia
