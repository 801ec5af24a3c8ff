#include "tools/learn/learn_commands.h"
#include "tools/learning/crig_config.h"
#include "tools/learning/default_model.h"
#include "tools/learning/model_config.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iostream>

namespace pluvia {
namespace {

void print_part(const SafetensorsFile& file, const char* name, const char* prefix) {
    int64_t values = 0, tensors = 0;
    for (const auto& [key, shape] : shapes_below(file.entries(), prefix)) ++tensors, values += element_count(shape);
    if (tensors > 0) std::cout << fmt::format("{:<14}{} tensors, {} values\n", name, tensors, values);
}

std::string unet_text(const UNetConfig& u) {
    return fmt::format("{} channels x {}, {} blocks a level, attention in the middle{}{}{}", u.channels,
                       fmt::join(u.multipliers, ","), u.res_blocks, u.attention_factors.empty() ? "" : " and at 1/",
                       fmt::join(u.attention_factors, ", 1/"),
                       u.context_channels > 0 ? fmt::format(", guide of {} channels", u.context_channels) : "");
}

void print_crig(const SafetensorsFile& file) {
    const CrigConfig c = crig_config(file);
    std::cout << "model         CRIGNet\n";
    print_part(file, "generator", crig_prefix);
    std::cout << fmt::format("              {} channels, latent of {} values, label of {}, pictures of {} pixels\n",
                             c.channels, c.latent, crig_labels, crig_side);
}

void info_command(const std::string& path) {
    const SafetensorsFile file(path.empty() ? default_model_path() : path);
    if (is_crig(file)) return print_crig(file);
    const ModelConfig c = model_config(file);
    std::cout << fmt::format("model         {}\n", model_kind_name(c.kind));
    print_part(file, "UNet", unet_prefix);
    std::cout << "              " << unet_text(c.unet) << "\n";
    print_part(file, "guiding model", guide_prefix);
    print_part(file, "first stage", first_stage_prefix);
    if (c.first_stage)
        std::cout << fmt::format("              {} channels x {}, {} codes, cells of {} pixels\n",
                                 c.first_stage->channels, fmt::join(c.first_stage->multipliers, ","),
                                 c.first_stage->codes, c.first_stage->factor());
    else if (c.kind == ModelConfig::Kind::diffusion)
        std::cout << fmt::format("{:<14}cells of {} pixels, no first stage\n", "", c.fold);
    for (const auto& [key, text] : c.metadata) std::cout << fmt::format("{:<14}{}\n", key, text.substr(0, 2000));
    for (const std::string& notice : c.notices) std::cout << "notice        " << notice << "\n";
}

}  // namespace

void add_learn_info_command(CLI::App& learn) {
    auto* command = learn.add_subcommand("info", "what a file of weights holds; checks it without loading a network");
    auto path = std::make_shared<std::string>();
    command->add_option("model", *path, "weights, .safetensors; default: those that come with Pluvia");
    command->footer("Example:\n  pluvia learn info model.safetensors");
    command->callback([path] { info_command(*path); });
}

}  // namespace pluvia
