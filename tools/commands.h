// The sub-commands of the program, each in a file of its own.
#pragma once

#include <CLI/CLI.hpp>

namespace pluvia {

void add_render_command(CLI::App& app);
void add_scenes_command(CLI::App& app);
void add_inspect_command(CLI::App& app);
void add_validate_command(CLI::App& app);
void add_sky_command(CLI::App& app);
void add_learn_command(CLI::App& app);
void add_dataset_command(CLI::App& app);
void add_labels_command(CLI::App& app);
void add_streaks_command(CLI::App& app);
void add_augment_command(CLI::App& app);

/// The whole program but for its process: parses, runs and reports errors on stderr. Returns the exit code.
int run(int argc, const char* const* argv);

}  // namespace pluvia
