// The program behind those commands of `pluvia learn` that need libtorch.
#include "tools/command_line.h"
#include "tools/learn/learn_commands.h"
#include "tools/learning/synthesis.h"
#include "tools/learning/trained_scores.h"

namespace {

using namespace pluvia;

TrainedScores open_trained_scores(const std::string& lpips, const std::string& fid) {
    TrainedScores scores;
    if (!lpips.empty())
        scores.lpips = [score = std::make_shared<LpipsScore>(lpips)](const auto& a, const auto& b) {
            return (*score)(a, b);
        };
    if (!fid.empty()) {
        const auto score = std::make_shared<FidScore>(fid);
        scores.add_to_fid = [score](const auto& a, const auto& b) { score->add(a, b); };
        scores.fid = [score] { return score->distance(); };
    }
    return scores;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Rain by a neural network.", "pluvia learn");
    app.require_subcommand(1);
    app.get_formatter()->column_width(34);
    pluvia::add_learn_infer_command(app);
    pluvia::add_learn_train_command(app);
    pluvia::add_learn_crig_command(app);
    pluvia::add_learn_evaluate_command(app, [](const std::string& lpips, const std::string& fid, const auto&) {
        set_learning_threads(0);
        return open_trained_scores(lpips, fid);
    });
    return pluvia::parse_and_run(app, argc, argv);
}
