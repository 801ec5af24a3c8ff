// Settings of `pluvia render` as the command line gives them, checked and turned into those of the renderer.
#pragma once

#include "renderer/image/depth_encoding.h"
#include "renderer/transport/render.h"
#include "tools/light_options.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <optional>
#include <string>

namespace pluvia {

/// Everything that decides over the bytes of a frame, in the units of the command line.
struct RenderOptions {
    std::string scene, output;
    std::string variant;  // of the scene's materials
    bool allow_outside = false;
    std::string camera;
    int frame = 0;
    double fps = 24;
    std::string size = "1024x512";
    int spp = 64;
    std::optional<double> target_error;  // chooses spp, which the frame records in its stead
    int bounces = -1;                    // -1 = unlimited
    std::optional<int> texture_size;     // texels; empty: as the file has them
    std::vector<double> rain;
    std::vector<double> wind = {0, 0, 0};
    std::vector<double> wind_travel;  // empty: wind times the time
    std::string composition = "physical";
    double streak_gain = 24.5;
    double streak_distance = 0, streak_share = 1;
    std::string streaks;                 // folder of a streak database; empty: Pluvia's own
    std::optional<double> streak_width;  // empty: 1/4, or 1 with the paper's composition
    double fog_beta = 0;
    std::string veil = "traced";
    std::vector<double> camera_velocity;  // empty = as the scene has it
    double wetness = 0, puddles = 0, ripples = 0;
    std::vector<double> wet_wind;  // empty: wind
    LightOptions light;
    std::optional<double> focal_length, f_number, focus;  // mm, -, m
    double shutter = 1.0 / 60;
    std::string exposure = "auto", view = "srgb";
    std::vector<std::string> layers;  // of labels
    std::string labels;               // file of rules that give classes
    std::string depth_encoding = "kitti16";
    double depth_max = 100;
    uint64_t seed = 0;
    std::optional<uint64_t> rain_seed;  // empty: seed
    int threads = 0;
    bool overwrite = false, json = false;
    std::string progress = "bar";
};

/// In pixels: the paper draws no drops below one, and what is finer here is a medium.
inline double streak_width(const RenderOptions& options) {
    return options.streak_width.value_or(options.composition == "paper" ? 1 : RainSettings().min_width_pixels);
}

/// Those of the rain itself, for every command that makes some.
void add_rain_options(CLI::App& command, RenderOptions& options);
void add_render_options(CLI::App& command, RenderOptions& options);

/// Throw Error (usage) naming the option, what was given and what is expected.
CameraSettings camera_settings(const RenderOptions& options);
RenderSettings render_settings(const RenderOptions& options);
/// Empty where the exposure is measured from the picture.
std::optional<double> exposure_ev100(const RenderOptions& options);
/// What makes a white unlit surface (KHR_materials_unlit) white in the picture, in cd/m2: at a given exposure the
/// brightest that is displayed; where the exposure is measured, the luminance of white paper under the environment's
/// sky, or 100 where there is none.
float unlit_luminance(const std::optional<double>& ev100, const Environment& environment);

/// Options that decide over the picture, with their values, as recorded in every file.
nlohmann::ordered_json to_json(const RenderOptions& options);

}  // namespace pluvia
