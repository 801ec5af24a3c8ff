#include "tools/command_line.h"

#include "renderer/core/error.h"

#include <iostream>
#include <new>

namespace pluvia {

int parse_and_run(CLI::App& app, int argc, const char* const* argv) {
    try {
        app.parse(argc, argv);
        return int(ExitCode::ok);
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() == 0) return app.exit(e);  // --help and --version
        // CLI11 would only say that a command is missing.
        const bool unknown = argc > 1 && argv[1][0] != '-' &&
                             app.get_subcommands([&](const CLI::App* c) { return c->get_name() == argv[1]; }).empty();
        std::cerr << "pluvia: error: command line: "
                  << (unknown ? std::string("there is no command \"") + argv[1] + '"' : e.what()) << "; see "
                  << app.get_name() << " --help\n";
        return int(ExitCode::usage);
    } catch (const Error& e) {
        std::cerr << "pluvia: error: " << e.what() << "\n";
        return int(e.code());
    } catch (const std::bad_alloc&) {
        std::cerr << "pluvia: error: memory: there is not enough for this\n";
        return int(ExitCode::render_failed);
    } catch (const std::exception& e) {  // of a library; better a line than an abort
        std::cerr << "pluvia: error: program: " << e.what() << "\n";
        return int(ExitCode::render_failed);
    }
}

}  // namespace pluvia
