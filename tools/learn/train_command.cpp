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
    std::string dataset, background, mask, truth, output, kind = "regression", from;
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
    TrainingSettings settings = o.settings;
    if (o.kind == "diffusion") settings.kind = ModelConfig::Kind::diffusion;
    Trainer trainer(pairs, settings);
    pairs.clear();
    if (!o.from.empty()) trainer.start_from(o.from);

    std::error_code error;
    fs::create_directories(o.output, error);
    if (error) throw Error(ExitCode::render_failed, o.output, fmt::format("cannot be made ({})", error.message()));
    const std::string checkpoint = o.output + "/checkpoint.safetensors";
    if (fs::exists(checkpoint)) {
        trainer.load(checkpoint);
        std::cerr << fmt::format("pluvia: going on from step {} of {}\n", trainer.step(), checkpoint);
    }
    LossLog log(o.output + "/log.csv", trainer.step());
    double loss = 0;
    const auto log_losses = [&] {
        const std::vector<double> losses = trainer.take_losses();
        for (size_t i = 0; i < losses.size(); ++i)
            log.add(trainer.step() - int(losses.size()) + int(i), loss = losses[i]);
    };
    const auto save = [&] {
        log_losses();
        trainer.save(checkpoint);
        trainer.save_model(o.output + "/model.safetensors",
                           fmt::format("{} steps on {} pairs, batch {}, crop {}, learning rate {}, seed {}{}",
                                       trainer.step(), files.size(), settings.batch, settings.crop,
                                       settings.learning_rate, settings.seed, o.note.empty() ? "" : "; " + o.note));
        log.write();
        log.plot(o.output + "/loss.svg");
    };
    catch_interrupts();
    bool stopped = false;
    {
        Progress progress(style, "training");
        while (trainer.step() < settings.steps && !stopped) {
            trainer.train_step();
            // Reading a loss waits for the device.
            if (trainer.step() % 10 == 0) log_losses();
            stopped = !progress.update(double(trainer.step()) / settings.steps);
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
        "Pictures are kept in memory: 23 bytes a pixel and pair at first, 10 bytes while training, on the device.");
    auto options = std::make_shared<TrainOptions>();
    TrainOptions& o = *options;
    command->add_option("--dataset", o.dataset, "trainset.json of a dataset in HRI's layout");
    command->add_option("--background", o.background, "or: folder of clean pictures");
    command->add_option("--mask", o.mask, "folder of rain layers with alpha, or masks, of the same names");
    command->add_option("--truth", o.truth, "folder of rainy pictures of the same names");
    command->add_option("-o,--output", o.output, "folder")->required();
    command
        ->add_option(
            "--kind", o.kind,
            "regression: one pass, the mean of what rain may do; diffusion: one possible rain, drawn from noise")
        ->check(CLI::IsMember({"regression", "diffusion"}))
        ->capture_default_str();
    command->add_option("--steps", o.settings.steps, "of optimisation, in all")->capture_default_str();
    command->add_option("--batch", o.settings.batch, "crops a step")->capture_default_str();
    command->add_option("--crop", o.settings.crop, "side of a crop, pixels")->capture_default_str();
    command->add_option("--channels", o.settings.channels, "width of the network; of diffusion's guide half of it")
        ->capture_default_str();
    command->add_option("--learning-rate", o.settings.learning_rate, "at its highest")->capture_default_str();
    command->add_option("--seed", o.settings.seed, "of weights and crops")->capture_default_str();
    command->add_option("--from", o.from, "model whose weights are the first ones, trained on with other pictures");
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
