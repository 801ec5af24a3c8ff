// pluvia validate and its sub-commands, each in a file of its own.
#pragma once

#include <CLI/CLI.hpp>

namespace pluvia {

void add_compare_command(CLI::App& validate);
void add_closed_forms_command(CLI::App& validate);
void add_extremes_command(CLI::App& validate);
void add_trade_command(CLI::App& validate);

}  // namespace pluvia
