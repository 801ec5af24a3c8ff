// Parts of `pluvia learn`: those that need no libtorch, and those of the program that has it.
#pragma once

#include "renderer/core/rgb.h"
#include "renderer/image/image.h"

#include <CLI/CLI.hpp>

#include <functional>
#include <string>
#include <vector>

namespace pluvia {

/// Scores by networks that others trained, from files that the user brings.
struct TrainedScores {
    std::function<double(const Image<Rgb>& prediction, const Image<Rgb>& truth)> lpips;  // empty: not asked for
    std::function<void(const Image<Rgb>& prediction, const Image<Rgb>& truth)> add_to_fid;
    std::function<double()> fid;
};
/// lpips, fid: files, or empty. arguments: those that the command was given.
using OpenTrainedScores = std::function<TrainedScores(const std::string& lpips, const std::string& fid,
                                                      const std::vector<std::string>& arguments)>;
void add_learn_evaluate_command(CLI::App& learn, OpenTrainedScores open);
void add_learn_info_command(CLI::App& learn);
void add_learn_mask_command(CLI::App& learn);

// Of the program pluvia_learn.
void add_learn_infer_command(CLI::App& learn);
void add_learn_train_command(CLI::App& learn);
void add_learn_crig_command(CLI::App& learn);

}  // namespace pluvia
