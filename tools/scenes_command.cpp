#include "renderer/core/error.h"
#include "renderer/scene/gltf.h"
#include "scenes/builders.h"
#include "scenes/traffic.h"
#include "tools/commands.h"

#include <fmt/format.h>

#include <filesystem>
#include <iostream>

namespace pluvia {
namespace {

struct ScenesOptions {
    std::vector<std::string> names;
    std::string output = ".";
    bool list = false, traffic = false;
};

void scenes_command(const ScenesOptions& options) {
    if (options.list) {
        for (const Builder& builder : builders())
            std::cout << fmt::format("{:<16}{}\n", builder.name, builder.description);
        return;
    }
    std::vector<const Builder*> chosen;
    for (const std::string& name : options.names) {
        const auto found =
            std::find_if(builders().begin(), builders().end(), [&](const Builder& b) { return b.name == name; });
        if (found == builders().end())
            throw usage_error("scenes",
                              fmt::format("no such scene (got \"{}\"; pluvia scenes --list names them)", name));
        chosen.push_back(&*found);
    }
    if (options.names.empty())
        for (const Builder& builder : builders()) chosen.push_back(&builder);
    std::error_code error;
    std::filesystem::create_directories(options.output, error);
    if (error)
        throw Error(ExitCode::render_failed, options.output, fmt::format("cannot be made ({})", error.message()));
    for (const Builder* builder : chosen) {
        const std::string path =
            fmt::format("{}/{}{}.glb", options.output, builder->name, options.traffic ? "-traffic" : "");
        Scene scene = builder->build();
        const std::vector<NodeMotion> motions = options.traffic ? add_traffic(scene) : std::vector<NodeMotion>();
        save_glb(scene, path, motions);
        std::cout << path << "\n";
    }
}

}  // namespace

void add_scenes_command(CLI::App& app) {
    auto* command = app.add_subcommand("scenes", "write the street scenes that come with Pluvia as .glb files");
    auto options = std::make_shared<ScenesOptions>();
    command->add_option("name", options->names, "scenes to write; default: all");
    command->add_option("-o,--output", options->output, "folder")->capture_default_str();
    command->add_flag("--traffic", options->traffic,
                      "as NAME-traffic.glb: for 100 s with people who walk, cars where there is a carriageway, and a "
                      "camera \"drive\" that goes round with them");
    command->add_flag("--list", options->list, "list the scenes");
    command->footer("Example:\n  pluvia scenes lane -o out");
    command->callback([options] { scenes_command(*options); });
}

}  // namespace pluvia
