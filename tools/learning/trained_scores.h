// Scores of pictures by networks that others trained: LPIPS and FID, from files of weights that the user brings.
// No header of libtorch is needed to call this.
#pragma once

#include "renderer/core/rgb.h"
#include "renderer/image/image.h"

#include <memory>
#include <string>
#include <vector>

namespace pluvia {

/// LPIPS 0.1 of two pictures of one size, values in 0..1. The file has AlexNet's or VGG16's features and the linear
/// heads that belong to it; which of the two, its shapes tell.
class LpipsScore {
public:
    /// Throws Error (input) for files that are damaged or hold something else.
    explicit LpipsScore(const std::string& path);
    ~LpipsScore();
    /// Throws Error (input) for pictures smaller than 32 pixels.
    double operator()(const Image<Rgb>& a, const Image<Rgb>& b) const;
    const char* network() const;  // "AlexNet" or "VGG16"

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Frechet inception distance between two sets of pictures of any size, values in 0..1.
class FidScore {
public:
    /// Throws Error (input) for files that are damaged or hold something else.
    explicit FidScore(const std::string& path);
    ~FidScore();
    void add(const Image<Rgb>& prediction, const Image<Rgb>& truth);
    /// Throws Error (input) for fewer than two pictures.
    double distance() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// |mean a - mean b|^2 + trace(A + B - 2 (A B)^(1/2)) of sets of vectors with covariances A and B, which are divided by
/// their number less one. Sets from 2 vectors on. Source: Dowson and Landau 1982.
double frechet_distance(const std::vector<std::vector<double>>& a, const std::vector<std::vector<double>>& b);

}  // namespace pluvia
