#include "tools/commands.h"
#include "tools/validate/validate_commands.h"

namespace pluvia {

void add_validate_command(CLI::App& app) {
    auto* validate =
        app.add_subcommand("validate", "how far pictures are from a reference, and light from what is known on paper");
    validate->require_subcommand(1);
    validate->footer("Example:\n  pluvia validate compare a/frame.exr b/frame.exr");
    add_compare_command(*validate);
    add_closed_forms_command(*validate);
    add_extremes_command(*validate);
    add_trade_command(*validate);
}

}  // namespace pluvia
