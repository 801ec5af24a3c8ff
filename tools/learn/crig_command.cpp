#include "renderer/core/error.h"
#include "renderer/image/image_io.h"
#include "renderer/image/pending_file.h"
#include "tools/learn/learn_commands.h"
#include "tools/learn/picture_files.h"
#include "tools/learning/crig_pictures.h"
#include "tools/learning/synthesis.h"
#include "tools/progress.h"

#include <fmt/format.h>

#include <cmath>
#include <iostream>

namespace pluvia {
namespace {

namespace fs = std::filesystem;

constexpr int published_quality = 75;  // of JPEG: what Pillow takes where nothing is said

struct CrigOptions {
    std::string model, output, device = "cpu", progress = "bar";
    CrigSettings settings;
    double rain = NAN, wind = NAN;
    int count = 1, threads = 0;
    bool no_noise = false, png = false, overwrite = false;
};

void write_image(const std::string& path, const Image<Rgba8>& image, bool png) {
    const std::vector<std::byte> bytes = png ? encode_png(image) : encode_jpeg(image, published_quality);
    PendingFile file(path);
    file.stream().write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    file.commit();
}

void crig_command(CrigOptions o) {
    const auto style = Progress::style_from_name(o.progress);
    if (std::isnan(o.rain) != std::isnan(o.wind))
        throw usage_error("learn crig", "needs both --rain and --wind, or neither for labels by chance");
    if (!std::isnan(o.rain)) o.settings.label = crig_label(o.rain, o.wind);
    if (o.count < 1 || o.count > 1'000'000)
        throw usage_error("--count", fmt::format("is not valid (got {}, expected 1 to 1000000)", o.count));
    o.settings.noise = !o.no_noise;
    set_learning_threads(o.threads);
    CrigPictures pictures(o.model, o.settings, o.device);
    catch_interrupts();
    std::vector<LabelledPicture> list;
    int kept = 0;
    {
        Progress progress(style, "rain pictures");
        for (int i = 0; i < o.count; ++i) {
            const std::string name = fmt::format("rain_{}.{}", i, o.png ? "png" : "jpg"), path = o.output + "/" + name;
            CrigLabel label;
            if (!o.overwrite && fs::exists(path)) {
                label = pictures.skip();
                ++kept;
            } else {
                const CrigPicture picture = pictures.next();
                write_image(path, picture.image, o.png);
                label = picture.label;
            }
            list.push_back({name, label.intensity, label.wind});
            if (!progress.update(double(i + 1) / o.count) && i + 1 < o.count)
                throw Error(ExitCode::stopped_early, o.output, "was interrupted; run it again to go on");
        }
    }
    write_picture_labels(o.output + "/data_info.json", list);
    std::cout << fmt::format("{}: {} rain pictures, {} of them were there already\n", o.output, o.count, kept);
}

}  // namespace

void add_learn_crig_command(CLI::App& learn) {
    auto* command = learn.add_subcommand(
        "crig",
        "Rain pictures of 256 pixels by the published network CRIGNet, whose weights you bring; `learn mask` "
        "simulates\n"
        "such pictures instead. Without --rain and --wind each picture has a label by chance. Latents and noise are "
        "those\n"
        "that the published script draws from the same seed. data_info.json lists pictures and labels.");
    auto options = std::make_shared<CrigOptions>();
    CrigOptions& o = *options;
    command->add_option("--model", o.model, "weights, .safetensors (tools/learning/convert_checkpoint.py)")->required();
    command->add_option("-o,--output", o.output, "folder of rain_0.jpg, rain_1.jpg, ... and data_info.json")
        ->required();
    command->add_option("--rain", o.rain, "0 to 100 mm/h");
    command->add_option("--wind", o.wind, "-1 to 1, CRIGNet's own scale");
    command->add_option("--count", o.count, "of pictures")->capture_default_str();
    command->add_option("--seed", o.settings.seed, "of latents, labels and noise")->capture_default_str();
    command->add_flag("--one-latent", o.settings.one_latent, "one latent for all pictures, so that only labels differ");
    command->add_flag("--evaluation", o.settings.evaluation,
                      "normalise with the statistics that training stored; as published: with those of each picture");
    command->add_flag("--no-noise", o.no_noise, "no noise within the network; as published: another for each picture");
    command->add_flag("--round", o.settings.rounded, "bytes are rounded; as published: cut off");
    command->add_flag("--png", o.png, "rain_0.png, ... without loss; as published: JPEG of quality 75");
    command->add_option("--device", o.device, "cpu or cuda")->capture_default_str();
    command->add_option("--threads", o.threads, "0: all")->capture_default_str();
    command->add_flag("--overwrite", o.overwrite, "make pictures that are there again");
    command->add_option("--progress", o.progress, "bar, json or none")->capture_default_str();
    command->footer("Example:\n  pluvia learn crig --model crig.safetensors --rain 50 --wind -0.3 --count 10 -o rain");
    command->callback([options] { crig_command(*options); });
}

}  // namespace pluvia
