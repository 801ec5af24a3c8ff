// The scenes of a dataset, loaded one at a time.
#pragma once

#include "tools/clock.h"
#include "tools/dataset/config.h"
#include "tools/frame_render.h"

#include <optional>
#include <string>

namespace pluvia {

/// Throws Error (usage) with the configuration's file when a scene is neither built by Pluvia nor a file.
void require_scene(const DatasetConfig& config, size_t scene);

class SceneSource {
public:
    /// scratch: a folder where a built scene is written before it is read back, so that a frame is what `pluvia render`
    /// makes of the file that `pluvia scenes` writes.
    SceneSource(const DatasetConfig& config, std::string scratch) : config_(&config), scratch_(std::move(scratch)) {}

    /// Hash of the scene as it is at the start of its sequences, 16 hexadecimal digits. Throws Error: usage when there
    /// is no such scene or one of its cameras is missing, input when its file cannot be read.
    std::string hash(size_t scene);

    /// options: those of a frame, whose time decides where the scene is animated.
    const FrameScene& at(size_t scene, const RenderOptions& options);

    /// What reading the scene that at() gave last took; building it does not count, nor that it was there already.
    SpentTime load_time() const { return load_time_; }

private:
    /// All that decides over what is read.
    struct Load {
        std::string file, variant;
        double time = 0, exposure_time = 0, fps = 0;  // of animations
        bool allow_outside = false, flow = false;
        std::optional<int> texture_size;
        bool operator==(const Load&) const = default;
    };
    Load load_of(const DatasetScene& scene, const RenderOptions& options) const;

    const DatasetConfig* config_;
    std::string scratch_;
    Load load_;
    SpentTime load_time_;
    std::optional<FrameScene> loaded_;
};

}  // namespace pluvia
