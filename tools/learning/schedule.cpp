#include "tools/learning/schedule.h"

#include <cmath>

namespace pluvia {

double DdimStep::next_noise() const {
    return std::sqrt(eps_scale * eps_scale + sigma * sigma);
}

std::vector<double> alphas_cumprod(const DiffusionConfig& c) {
    std::vector<double> alphas(c.times);
    double product = 1;
    for (int t = 0; t < c.times; ++t) {
        const double position = c.times > 1 ? double(t) / (c.times - 1) : 0;
        const double root = std::sqrt(c.first_beta) + position * (std::sqrt(c.last_beta) - std::sqrt(c.first_beta));
        alphas[t] = product *= 1 - root * root;
    }
    return alphas;
}

DdimStep ddim_step(const std::vector<double>& alphas, int time, int time_before, double eta) {
    const double a = alphas[time], before = alphas[time_before];
    DdimStep step;
    step.time = time;
    step.signal = std::sqrt(a);
    step.noise_share = std::sqrt(1 - a);
    step.next_signal = std::sqrt(before);
    step.sigma = eta * std::sqrt((1 - before) / (1 - a)) * std::sqrt(1 - a / before);
    step.eps_scale = std::sqrt(std::max(0.0, 1 - before - step.sigma * step.sigma));
    return step;
}

std::vector<DdimStep> ddim_steps(const DiffusionConfig& config, int steps, double eta) {
    const std::vector<double> alphas = alphas_cumprod(config);
    // As published: times 1, 1 + stride, ...; a number of steps that does not divide the times gives some more.
    const int stride = config.times / steps;
    std::vector<DdimStep> result;
    for (int i = (config.times - 1) / stride; i >= 0; --i) {
        const int time = i * stride + 1;
        if (time < config.times) result.push_back(ddim_step(alphas, time, i > 0 ? time - stride : 0, eta));
    }
    return result;
}

}  // namespace pluvia
