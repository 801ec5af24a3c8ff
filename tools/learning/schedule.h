// The diffusion's schedule and the steps of DDIM, as numbers; who predicts the noise is no matter here.
// Source: Ho et al. 2020 (schedule), Song et al. 2021 (DDIM, equations 12 and 16).
#pragma once

#include <vector>

namespace pluvia {

struct DiffusionConfig {
    int times = 1000;
    double first_beta = 0.0015, last_beta = 0.0195;  // of steps whose square roots are evenly spaced
};

/// What one step asks for and does: next = clean_scale * (x - noise_share * eps) / signal + eps_scale * eps
/// + sigma * fresh noise.
struct DdimStep {
    int time = 0;                        // given to the network
    double signal = 1, noise_share = 0;  // x = signal * clean + noise_share * eps, before the step
    double next_signal = 1;              // after it
    double eps_scale = 0, sigma = 0;

    /// Factors of x, eps and fresh noise in the next x.
    double x_factor() const { return next_signal / signal; }
    double eps_factor() const { return eps_scale - next_signal * noise_share / signal; }
    /// Share of noise in the next x, fresh or not.
    double next_noise() const;
};

/// Share of the signal's variance that is left at each time.
std::vector<double> alphas_cumprod(const DiffusionConfig& config);

/// Evenly spaced times from about the last down to 1, each step going to the one before, the last one to time 0.
/// steps: 1 to config.times. eta: 0 (nothing random after the start) to 1.
std::vector<DdimStep> ddim_steps(const DiffusionConfig& config, int steps, double eta);
/// One step between two times.
DdimStep ddim_step(const std::vector<double>& alphas, int time, int time_before, double eta);

}  // namespace pluvia
