#include "renderer/core/error.h"
#include "renderer/core/parallel.h"
#include "tools/learn/learn_commands.h"
#include "tools/learn/training_files.h"
#include "tools/learning/synthesis.h"
#include "tools/progress.h"

#include <fmt/format.h>

#include <filesystem>
#include <iostream>

namespace pluvia {
namespace {

namespace fs = std::filesystem;

struct TrainOptions {
    std::string dataset, background, mask, truth, output;
    TrainingSettings settings;
    int checkpoint_every = 500;
    int threads = 0;
    std::string note, progress = "bar";
};

void train_command(const TrainOptions& o) {
    const auto style = Progress::style_from_name(o.progress);
    if (o.dataset.empty() == (o.background.empty() || o.mask.empty() || o.truth.empty()))
        throw usage_error("learn train", "needs either --dataset or all of --background, --mask and --truth");
    if (o.checkpoint_every < 1)
        throw usage_error("--checkpoint-every",
                          fmt::format("is not valid (got {}, expected 1 or more)", o.checkpoint_every));
    set_thread_count(o.threads);
    set_learning_threads(o.threads);
    const auto files =
        o.dataset.empty() ? training_files(o.background, o.mask, o.truth) : training_files_of_dataset(o.dataset);
    std::vector<TrainingPair> pairs(files.size());
    parallel_for(int(files.size()), [&](int i) { pairs[i] = read_training_pair(files[i]); });
    Trainer trainer(std::move(pairs), o.settings);

    std::error_code error;
    fs::create_directories(o.output, error);
    if (error) throw Error(ExitCode::render_failed, o.output, fmt::format("cannot be made ({})", error.message()));
    const std::string checkpoint = o.output + "/checkpoint.safetensors";
    if (fs::exists(checkpoint)) {
        trainer.load(checkpoint);
        std::cerr << fmt::format("pluvia: going on from step {} of {}\n", trainer.step(), checkpoint);
    }
    LossLog log(o.output + "/log.csv", trainer.step());
    const auto save = [&] {
        trainer.save(checkpoint);
        trainer.save_model(
            o.output + "/model.safetensors",
            fmt::format("{} steps on {} pairs, batch {}, crop {}, seed {}{}", trainer.step(), files.size(),
                        o.settings.batch, o.settings.crop, o.settings.seed, o.note.empty() ? "" : "; " + o.note));
        log.write();
        log.plot(o.output + "/loss.svg");
    };
    catch_interrupts();
    bool stopped = false;
    double loss = 0;
    {
        Progress progress(style, "training");
        while (trainer.step() < o.settings.steps && !stopped) {
            const int step = trainer.step();
            log.add(step, loss = trainer.train_step());
            stopped = !progress.update(double(trainer.step()) / o.settings.steps);
            if (stopped || trainer.step() % o.checkpoint_every == 0) save();
        }
    }
    save();
    if (stopped)
        throw Error(ExitCode::stopped_early, o.output,
                    fmt::format("training was interrupted after step {}; run it again to go on", trainer.step()));
    std::cout << fmt::format("{}/model.safetensors: {} steps, last loss {:.4g}\n", o.output, trainer.step(), loss);
}

}  // namespace

void add_learn_train_command(CLI::App& learn) {
    auto* command = learn.add_subcommand(
        "train",
        "Train a network that draws rain onto clean pictures, on pairs that were rendered. The output folder gets\n"
        "model.safetensors, checkpoint.safetensors, log.csv and loss.svg; run again, training goes on from there.\n"
        "Pictures are kept in memory: 11 bytes a pixel and pair.");
    auto options = std::make_shared<TrainOptions>();
    TrainOptions& o = *options;
    command->add_option("--dataset", o.dataset, "trainset.json of a dataset in HRI's layout");
    command->add_option("--background", o.background, "or: folder of clean pictures");
    command->add_option("--mask", o.mask, "folder of rain layers with alpha, or masks, of the same names");
    command->add_option("--truth", o.truth, "folder of rainy pictures of the same names");
    command->add_option("-o,--output", o.output, "folder")->required();
    command->add_option("--steps", o.settings.steps, "of optimisation, in all")->capture_default_str();
    command->add_option("--batch", o.settings.batch, "crops a step")->capture_default_str();
    command->add_option("--crop", o.settings.crop, "side of a crop, pixels")->capture_default_str();
    command->add_option("--channels", o.settings.channels, "width of the network")->capture_default_str();
    command->add_option("--learning-rate", o.settings.learning_rate, "at its highest")->capture_default_str();
    command->add_option("--seed", o.settings.seed, "of weights and crops")->capture_default_str();
    command->add_option("--checkpoint-every", o.checkpoint_every, "steps")->capture_default_str();
    command->add_option("--device", o.settings.device, "cpu or cuda")
        ->check(CLI::IsMember({"cpu", "cuda"}))
        ->capture_default_str();
    command->add_option("--note", o.note, "kept in the model: what the pictures are, for example");
    command->add_option("--threads", o.threads, "0: all")->capture_default_str();
    command->add_option("--progress", o.progress, "bar, json or none")->capture_default_str();
    command->footer("Example:\n  pluvia learn train --dataset hri/trainset.json --steps 20000 -o training");
    command->callback([options] { train_command(*options); });
}

}  // namespace pluvia
