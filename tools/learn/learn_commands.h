// Parts of `pluvia learn`: those that need no libtorch, and those of the program that has it.
#pragma once

#include <CLI/CLI.hpp>

namespace pluvia {

void add_learn_evaluate_command(CLI::App& learn);
void add_learn_info_command(CLI::App& learn);
void add_learn_mask_command(CLI::App& learn);

// Of the program pluvia_learn.
void add_learn_infer_command(CLI::App& learn);
void add_learn_train_command(CLI::App& learn);

}  // namespace pluvia
