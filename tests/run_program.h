// The program run as a user runs it.
#pragma once

#include "tests/temporary_folder.h"

#include <sys/wait.h>
#include <cstdlib>
#include <string>

namespace pluvia {

struct Outcome {
    int exit_code;
    std::string out, err;
};

inline Outcome run_program(const std::string& arguments) {
    const TemporaryFolder logs;
    const std::string command =
        std::string(PLUVIA_PROGRAM) + " " + arguments + " >" + (logs / "out") + " 2>" + (logs / "err") + " </dev/null";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), read_file(logs / "out"),
            read_file(logs / "err")};
}

}  // namespace pluvia
