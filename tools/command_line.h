// A command line parsed and run, and what went wrong said in one line: the same for every program here.
#pragma once

#include <CLI/CLI.hpp>

namespace pluvia {

/// Returns the exit code. Errors go to stderr as "pluvia: error: WHERE: WHAT".
int parse_and_run(CLI::App& app, int argc, const char* const* argv);

}  // namespace pluvia
