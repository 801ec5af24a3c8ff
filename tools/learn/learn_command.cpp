// `pluvia learn`: what needs libtorch is a program of its own beside this one, so that nothing else waits for it.
#include "renderer/core/error.h"
#include "tools/commands.h"
#include "tools/learn/learn_commands.h"

#include <unistd.h>
#include <cstdlib>
#include <cstring>
#include <filesystem>

namespace pluvia {
namespace {

namespace fs = std::filesystem;

/// Becomes the program pluvia_learn.
void run_learning_program(const std::string& command, const std::vector<std::string>& arguments) {
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error).parent_path() / "pluvia_learn";
    if (!fs::exists(program, error))
        throw usage_error("learn " + command,
                          "needs libtorch: apt-get install libtorch-dev libopenblas0-pthread, then configure and build "
                          "again (cmake -S . -B build && cmake --build build)");
    // Threads of OpenMP that spin while they wait cost several times what they compute.
    setenv("OMP_WAIT_POLICY", "PASSIVE", 0);
    std::vector<const char*> argv = {"pluvia learn", command.c_str()};
    for (const std::string& a : arguments) argv.push_back(a.c_str());
    argv.push_back(nullptr);
    execv(program.c_str(), const_cast<char* const*>(argv.data()));
    throw Error(ExitCode::render_failed, program.string(), std::string("cannot be started (") + strerror(errno) + ")");
}

/// All options, --help included, are the program's own.
void add_passed_on(CLI::App& learn, const std::string& name, const std::string& description) {
    auto* command = learn.add_subcommand(name, description);
    command->set_help_flag();
    command->prefix_command();
    command->callback([command, name] { run_learning_program(name, command->remaining()); });
}

}  // namespace

void add_learn_command(CLI::App& app) {
    auto* learn =
        app.add_subcommand("learn", "rain by a neural network: clean picture and rain mask in, rainy picture out");
    learn->require_subcommand(1);
    add_passed_on(*learn, "infer", "rainy pictures of clean pictures and rain masks");
    add_passed_on(*learn, "train", "train a network on pairs of clean and rainy pictures");
    add_passed_on(*learn, "crig", "rain pictures by the published network CRIGNet");
    add_learn_evaluate_command(*learn, [](const auto&, const auto&, const std::vector<std::string>& arguments) {
        run_learning_program("evaluate", arguments);
        return TrainedScores();
    });
    add_learn_info_command(*learn);
    add_learn_mask_command(*learn);
    learn->footer(
        "infer, train and crig need libtorch when Pluvia is built: apt-get install libtorch-dev libopenblas0-pthread.\n"
        "Example:\n  pluvia learn mask --rain 50 --size 2048x1024 -o masks\n"
        "  pluvia learn infer --background clean --mask masks -o rainy");
}

}  // namespace pluvia
