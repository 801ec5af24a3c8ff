#include "tools/commands.h"

#include "renderer/core/error.h"

#include <iostream>
#include <new>

namespace pluvia {

int run(int argc, const char* const* argv) {
    CLI::App app(
        "Pluvia: path-traced street scenes in the rain. Clean background, depth, every streak's light and the\n"
        "rainy picture in one pass, for several intensities at once.",
        "pluvia");
    app.set_version_flag("--version", PLUVIA_VERSION);
    app.require_subcommand(1);
    app.get_formatter()->column_width(34);
    app.footer(
        "Exit codes: 0 ok, 1 a check failed, 2 usage, 3 input unreadable or unsupported, 4 render failed,\n"
        "5 some items failed, 75 stopped early.\n"
        "Example:\n  pluvia scenes lane -o out && pluvia render out/lane.glb --rain 10,50 -o out/lane");
    add_render_command(app);
    add_scenes_command(app);
    add_inspect_command(app);
    add_validate_command(app);
    add_sky_command(app);
    try {
        app.parse(argc, argv);
        return int(ExitCode::ok);
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() == 0) return app.exit(e);  // --help and --version
        // CLI11 would only say that a command is missing.
        const bool unknown = argc > 1 && argv[1][0] != '-' &&
                             app.get_subcommands([&](const CLI::App* c) { return c->get_name() == argv[1]; }).empty();
        std::cerr << "pluvia: error: command line: "
                  << (unknown ? std::string("there is no command \"") + argv[1] + '"' : e.what())
                  << "; see pluvia --help\n";
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
