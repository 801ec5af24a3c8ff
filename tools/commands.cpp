#include "tools/commands.h"

#include "tools/command_line.h"

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
    add_learn_command(app);
    add_dataset_command(app);
    add_labels_command(app);
    add_streaks_command(app);
    add_augment_command(app);
    return parse_and_run(app, argc, argv);
}

}  // namespace pluvia
