#include "tools/dataset/scene_source.h"

#include "renderer/core/error.h"
#include "renderer/scene/gltf.h"
#include "scenes/builders.h"
#include "scenes/traffic.h"
#include "tools/dataset/suggestion.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace pluvia {
namespace {

std::vector<std::string> builder_names() {
    std::vector<std::string> names;
    for (const Builder& builder : builders()) names.push_back(builder.name);
    return names;
}

const Builder* find_builder(const std::string& name) {
    const auto found =
        std::find_if(builders().begin(), builders().end(), [&](const Builder& b) { return b.name == name; });
    return found == builders().end() ? nullptr : &*found;
}

}  // namespace

void require_scene(const DatasetConfig& config, size_t index) {
    const DatasetScene& scene = config.scenes[index];
    if (scene.is_built && !find_builder(scene.source))
        throw usage_error(config.path, fmt::format("there is no scene \"{}\" (expected {}, or a glTF file)",
                                                   scene.source, fmt::join(builder_names(), ", ")));
    std::error_code ignored;
    if (!scene.is_built && !std::filesystem::exists(scene.source, ignored))
        throw usage_error(config.path,
                          fmt::format("there is no file {} for the scene \"{}\"", scene.source, scene.name));
}

std::string SceneSource::hash(size_t index) {
    const DatasetScene& scene = config_->scenes[index];
    const FrameScene& loaded = at(index, scene.options);
    for (const auto* cameras : {&scene.train, &scene.test})
        for (const std::string& camera : *cameras) {
            const auto& known = loaded.scene.cameras;
            if (std::any_of(known.begin(), known.end(), [&](const Camera& c) { return c.name == camera; })) continue;
            std::vector<std::string> names;
            for (const Camera& c : known) names.push_back(c.name);
            const std::string near = nearest_word(camera, names);
            throw usage_error(config_->path,
                              fmt::format("the scene \"{}\" has no camera \"{}\" (expected {}){}", scene.name, camera,
                                          fmt::join(names, ", "), near.empty() ? "" : "; did you mean " + near + "?"));
        }
    return fmt::format("{:016x}", loaded.hash);
}

SceneSource::Load SceneSource::load_of(const DatasetScene& scene, const RenderOptions& options) const {
    const CameraSettings camera = camera_settings(options);
    Load load;
    load.file = scene.is_built ? fmt::format("{}/{}{}.glb", scratch_, scene.source, scene.traffic ? "-traffic" : "")
                               : scene.source;
    load.variant = options.variant;
    load.time = camera.mid_exposure, load.exposure_time = camera.exposure_time, load.fps = options.fps;
    load.allow_outside = options.allow_outside;
    load.flow = label_choice(options.layers).layers.flow;
    load.texture_size = options.texture_size;
    return load;
}

const FrameScene& SceneSource::at(size_t index, const RenderOptions& options) {
    const DatasetScene& scene = config_->scenes[index];
    const Load load = load_of(scene, options);
    Load held = load_;
    if (loaded_ && !loaded_->is_animated)
        held.time = load.time, held.exposure_time = load.exposure_time, held.fps = load.fps, held.flow = load.flow;
    if (loaded_ && held == load) return *loaded_;
    loaded_.reset();  // never two at a time
    require_scene(*config_, index);
    std::error_code ignored;
    if (scene.is_built && !std::filesystem::exists(load.file, ignored)) {
        Scene built = find_builder(scene.source)->build();
        const std::vector<NodeMotion> motions = scene.traffic ? add_traffic(built) : std::vector<NodeMotion>();
        save_glb(built, load.file, motions);
    }
    RenderOptions file = options;
    file.scene = load.file;
    const SpentTime start = spent_time();
    loaded_ = load_frame_scene(file);
    load_ = load, load_time_ = spent_time() - start;
    return *loaded_;
}

}  // namespace pluvia
