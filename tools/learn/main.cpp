// The program behind `pluvia learn infer` and `pluvia learn train`.
#include "tools/command_line.h"
#include "tools/learn/learn_commands.h"

int main(int argc, char** argv) {
    CLI::App app("Rain by a neural network.", "pluvia learn");
    app.require_subcommand(1);
    app.get_formatter()->column_width(34);
    pluvia::add_learn_infer_command(app);
    pluvia::add_learn_train_command(app);
    return pluvia::parse_and_run(app, argc, argv);
}
