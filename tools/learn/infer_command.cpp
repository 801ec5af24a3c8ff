#include "renderer/core/error.h"
#include "renderer/core/parallel.h"
#include "renderer/image/image_io.h"
#include "tools/learn/learn_commands.h"
#include "tools/learn/picture_files.h"
#include "tools/learning/default_model.h"
#include "tools/learning/synthesis.h"
#include "tools/progress.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <filesystem>
#include <iostream>

namespace pluvia {
namespace {

namespace fs = std::filesystem;

struct InferOptions {
    std::string background, mask, model, output;
    std::string device = "cpu", tiling = "joint", progress = "bar";
    SynthesisSettings settings;
    bool hard = false, no_anchor = false, overwrite = false;
    int threads = 0;
};

SynthesisSettings settings_of(const InferOptions& o) {
    SynthesisSettings s = o.settings;
    if (o.tiling != "joint" && o.tiling != "plain")
        throw usage_error("--tiling", fmt::format("is not valid (got \"{}\", expected joint or plain)", o.tiling));
    if (!(s.eta >= 0 && s.eta <= 1))
        throw usage_error("--eta", fmt::format("is not valid (got {}, expected 0 to 1)", s.eta));
    s.tiles.plain = o.tiling == "plain";
    s.anchor_latents = s.blend.anchor_colors = !o.no_anchor && !s.tiles.plain;
    s.blend.soft = !o.hard && !s.tiles.plain;
    return s;
}

/// Largest memory of this process until now, in GiB.
double peak_memory_gib() {
    rusage usage = {};
    getrusage(RUSAGE_SELF, &usage);
    return double(usage.ru_maxrss) / (1 << 20);
}

void write_picture(const std::string& path, const Image<Rgba8>& picture, const PngText& text) {
    std::vector<uint8_t> bytes;
    bytes.reserve(picture.pixels.size() * 3);
    for (const Rgba8& p : picture.pixels) bytes.insert(bytes.end(), {p.r, p.g, p.b});
    PngWriter writer(path, picture.width, picture.height, 3, 8, text);
    writer.write_rows(0, picture.height, bytes.data());
    writer.finish();
}

/// What decides over the bytes of the pictures.
PngText text_of(const InferOptions& o, const SynthesisSettings& s, const ModelConfig& model) {
    std::string text = fmt::format("{} model {}, tiling {}, tile {}", model_kind_name(model.kind),
                                   fs::path(o.model.empty() ? default_model_path() : o.model).filename().string(),
                                   o.tiling, s.tiles.size);
    if (!s.tiles.plain) text += fmt::format(", overlap {}", s.tiles.overlap);
    if (model.kind == ModelConfig::Kind::diffusion)
        text += fmt::format(", steps {}, eta {}, seed {}", s.steps, s.eta, s.seed);
    text += fmt::format(", anchored {}, soft {}, lighten {}", s.blend.anchor_colors, s.blend.soft, s.blend.lighten);
    return {{"pluvia:learn", text}};
}

void infer_command(const InferOptions& o) {
    const SynthesisSettings settings = settings_of(o);
    const auto style = Progress::style_from_name(o.progress);
    const std::vector<PicturePair> pairs = pair_pictures(o.background, o.mask);
    if (o.threads < 0)
        throw usage_error("--threads", fmt::format("is not valid (got {}, expected 0 or more)", o.threads));
    set_thread_count(o.threads);
    set_learning_threads(o.threads);
    const auto model = load_model(o.model.empty() ? default_model_path() : o.model, o.device);
    for (const std::string& notice : config_of(*model).notices) std::cerr << "pluvia: notice: " << notice << "\n";
    if (o.device == "cpu")
        if (const std::string notice = slow_blas_notice(); !notice.empty())
            std::cerr << "pluvia: warning: " << notice << "\n";
    std::error_code error;
    fs::create_directories(o.output, error);
    if (error) throw Error(ExitCode::render_failed, o.output, fmt::format("cannot be made ({})", error.message()));

    catch_interrupts();
    const PngText text = text_of(o, settings, config_of(*model));
    size_t kept = 0, failed = 0;
    {
        Progress progress(style, "inferring");
        for (size_t i = 0; i < pairs.size(); ++i) {
            const std::string path = o.output + "/" + pairs[i].name + ".png";
            if (!o.overwrite && fs::exists(path)) {
                ++kept;
                continue;
            }
            try {
                const auto picture = synthesize(
                    *model, read_rgba8(pairs[i].background), rain_coverage(read_rgba8(pairs[i].mask)), settings,
                    [&](double done) { return progress.update((double(i) + done) / double(pairs.size())); },
                    pairs[i].mask);
                write_picture(path, picture, text);
            } catch (const Error& e) {
                if (e.code() != ExitCode::input) throw;
                std::cerr << "pluvia: error: " << e.what() << "\n";
                ++failed;
            }
        }
    }
    std::cout << fmt::format("{}: {} rainy pictures, {} of them were there already; {:.2f} GiB of memory at most\n",
                             o.output, pairs.size() - failed, kept, peak_memory_gib());
    if (failed > 0)
        throw Error(ExitCode::some_failed, o.output, fmt::format("{} of {} pictures failed", failed, pairs.size()));
}

}  // namespace

void add_learn_infer_command(CLI::App& learn) {
    auto* command = learn.add_subcommand(
        "infer",
        "Rainy pictures of clean pictures and rain masks, of any size. Pixels without rain keep their bytes.\n"
        "Pictures that are there already are kept, so an interrupted run goes on where it was.");
    auto options = std::make_shared<InferOptions>();
    InferOptions& o = *options;
    command->add_option("--background", o.background, "clean pictures: a folder or one file")->required();
    command
        ->add_option("--mask", o.mask,
                     "rain layers with alpha, or grey masks: a folder with the same names, or one file for all")
        ->required();
    command->add_option("--model", o.model, "weights, .safetensors; default: those that come with Pluvia");
    command->add_option("-o,--output", o.output, "folder of the rainy pictures, PNG")->required();
    command->add_option("--steps", o.settings.steps, "of a diffusion model")->capture_default_str();
    command->add_option("--eta", o.settings.eta, "0 nothing random after the first noise, 1 as HRIGNet was published")
        ->capture_default_str();
    command->add_option("--seed", o.settings.seed, "of the noise")->capture_default_str();
    command->add_option("--tiling", o.tiling, "joint: overlapping tiles denoised together; plain: the published grid")
        ->capture_default_str();
    command->add_option("--tile", o.settings.tiles.size, "side of a tile, pixels")->capture_default_str();
    command->add_option("--overlap", o.settings.tiles.overlap, "of neighbouring tiles at least, pixels")
        ->capture_default_str();
    command->add_flag("--no-anchor", o.no_anchor, "do not hold a diffusion to the known pixels beside the rain");
    command->add_flag("--hard", o.hard, "no fading at the rims of streaks; models without a first stage never need it");
    command->add_flag("--lighten", o.settings.blend.lighten, "rain never darkens a pixel");
    command->add_option("--device", o.device, "cpu or cuda")->capture_default_str();
    command->add_option("--threads", o.threads, "0: all")->capture_default_str();
    command->add_flag("--overwrite", o.overwrite, "make pictures that are there again");
    command->add_option("--progress", o.progress, "bar, json or none")->capture_default_str();
    command->footer("Example:\n  pluvia learn infer --background clean --mask masks -o rainy");
    command->callback([options] { infer_command(*options); });
}

}  // namespace pluvia
