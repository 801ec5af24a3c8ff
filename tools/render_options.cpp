#include "tools/render_options.h"

#include "tools/quality.h"

namespace pluvia {
namespace {

/// CLI11 lets -1 wrap around and cuts what is larger.
CLI::Validator seed_range() {
    return CLI::Range(0.0, 0x1p64 * (1 - 0x1p-53)).description("");
}

}  // namespace

void add_rain_options(CLI::App& command, RenderOptions& o) {
    const auto* rain = "Rain (seen directly, not in mirrors, puddles or through glass)";
    command
        .add_option("--rain", o.rain,
                    "intensities in mm/h, e.g. 10,25,50,100; 0 to 1000 (drop sizes are a fit up to about 500)")
        ->delimiter(',')
        ->group(rain);
    command.add_option("--wind", o.wind, "X,Y,Z in m/s")->delimiter(',')->expected(3)->group(rain);
    command
        .add_option("--wind-travel", o.wind_travel,
                    "X,Y,Z: metres that the air has moved since the sequence began; default: wind times the time; for "
                    "sequences in which the wind changes and drops go on from frame to frame")
        ->delimiter(',')
        ->expected(3)
        ->group(rain);
    command.add_option("--rain-seed", o.rain_seed, "of the drops; default: --seed")->check(seed_range())->group(rain);
    command.add_option("--composition", o.composition, "physical, or paper: the formula of 'Learning from Rendering'")
        ->capture_default_str()
        ->group(rain);
    command
        .add_option("--streak-gain", o.streak_gain,
                    "paper: factor on the light of streaks; 1 = exact, 24.5 = the published code")
        ->capture_default_str()
        ->group(rain);
    command
        .add_option("--streak-distance", o.streak_distance,
                    "paper: drops beyond this many metres are drawn as wide as at it and 3 of 2048 pixels at least, up "
                    "to 5 times as far; 1.78 = the published code, 0 = true width")
        ->capture_default_str()
        ->group(rain);
    command
        .add_option("--streak-share", o.streak_share,
                    "paper: share of the drops that is drawn; 0.024 = the published code's of drops wide enough")
        ->capture_default_str()
        ->group(rain);
    command
        .add_option("--streaks", o.streaks,
                    "paper: folder of a streak database in Garg and Nayar's layout; default: traced once and kept")
        ->group(rain);
    command
        .add_option("--streak-width", o.streak_width,
                    "pixels; narrower drops are not streaks but a medium [0.25]; paper: they are left out [1], with "
                    "--streak-distance pixels of a picture 2048 wide")
        ->group(rain);
    command
        .add_option("--fog-beta", o.fog_beta, "extinction in 1/m of a fog beside the rain; 0.001: one sees 4 km far")
        ->capture_default_str()
        ->group(rain);
}

void add_render_options(CLI::App& command, RenderOptions& o) {
    command.add_option("scene", o.scene, "glTF file, .glb or .gltf")->required();
    command.add_option("-o,--output", o.output, "folder for frame.exr, pictures and frame.json")->required();

    command.add_option("--variant", o.variant,
                       "which of the materials that a file has for its meshes; default: its first");
    command.add_flag("--allow-outside", o.allow_outside, "read files that the scene names outside of its folder");

    const auto* camera = "Camera";
    command.add_option("--camera", o.camera, "name or number; default: the first, or one that shows the whole scene")
        ->group(camera);
    command.add_option("--size", o.size, "WIDTHxHEIGHT in pixels; the vertical field of view stays")
        ->capture_default_str()
        ->group(camera);
    command.add_option("--frame", o.frame, "number of the frame; animations and rain are those at frame / fps seconds")
        ->capture_default_str()
        ->group(camera);
    command.add_option("--fps", o.fps, "frames per second")->capture_default_str()->group(camera);
    command
        .add_option("--focal-length", o.focal_length,
                    "mm on a sensor 36 mm wide; default: the camera's own field of view")
        ->group(camera);
    command.add_option("--f-number", o.f_number, "lens opening; default: pinhole")->group(camera);
    command.add_option("--focus", o.focus, "metres in focus [10]; needs --f-number")->group(camera);
    command.add_option("--shutter", o.shutter, "exposure time in seconds, which makes the streaks")
        ->capture_default_str()
        ->group(camera);
    command
        .add_option("--camera-velocity", o.camera_velocity,
                    "X,Y,Z in m/s; slants the streaks; default: as the file animates it")
        ->delimiter(',')
        ->expected(3)
        ->group(camera);

    const auto* quality = "Accuracy";
    // Before --spp: options are looked at in this order, so that samples which are given themselves win.
    command
        .add_option_function<std::string>(
            "--quality", [&o](const std::string& name) { set_quality(o, name); },
            "draft, standard, high or reference: --spp 16, 64, 256 or 1024 where that is not given; the README has "
            "errors and costs")
        ->group(quality);
    command.add_option("--spp", o.spp, "samples per pixel")->capture_default_str()->group(quality);
    command
        .add_option(
            "--bounces", o.bounces,
            "cut paths after this many, a raindrop being one of them; BIASED: loses light. -1 = unlimited, unbiased")
        ->capture_default_str()
        ->group(quality);
    command
        .add_option("--texture-size", o.texture_size,
                    "halve pictures of textures until none has a side of more texels: less memory; BIASED: blurs")
        ->group(quality);
    command
        .add_option("--veil", o.veil,
                    "light of drops no wider than a pixel: traced, or table: but for what lamps bring straight "
                    "interpolated between some thousand places of the view; rain takes a half to a sixth of "
                    "the time and has less noise, but is BIASED by about half a per cent; with fog always traced")
        ->capture_default_str()
        ->group(quality);
    command.add_option("--seed", o.seed, "of all random numbers")
        ->check(seed_range())
        ->capture_default_str()
        ->group(quality);

    add_rain_options(command, o);

    const auto* wet = "Wet ground (of the clean picture; where rain reaches, with --wind; what is marked stays dry)";
    command.add_option("--wetness", o.wetness, "film of water: 0 = dry, 1 = closed")->capture_default_str()->group(wet);
    command.add_option("--puddles", o.puddles, "share of level ground that water stands on, 0 to 1")
        ->capture_default_str()
        ->group(wet);
    command
        .add_option("--wet-wind", o.wet_wind,
                    "X,Y,Z in m/s while the ground got wet, which decides what is sheltered; default: --wind")
        ->delimiter(',')
        ->expected(3)
        ->group(wet);
    command.add_option("--ripples", o.ripples, "mm/h of the rain whose drops draw rings on the puddles, 0 to 1000")
        ->capture_default_str()
        ->group(wet);

    add_light_options(command, o.light);

    const auto* labels = "Labels (of the clean scene, from the ray through each pixel's centre)";
    command
        .add_option("--layers", o.layers,
                    "also write: semantic, instance, normals, albedo, position, flow, boxes, cryptomatte; or all")
        ->delimiter(',')
        ->group(labels);
    command
        .add_option("--labels", o.labels,
                    "YAML file of rules that give classes to nodes by their names; before those of the scene's file")
        ->group(labels);

    const auto* output = "Output";
    command.add_option("--exposure", o.exposure, "EV at ISO 100, or auto")->capture_default_str()->group(output);
    command.add_option("--view", o.view, "display transform of the PNGs: srgb, filmic, aces, raw")
        ->capture_default_str()
        ->group(output);
    command.add_option("--depth-encoding", o.depth_encoding, "of depth.png: kitti16, mm16, carla24, hri")
        ->capture_default_str()
        ->group(output);
    command.add_option("--depth-max", o.depth_max, "metres of a full value in the encoding hri")
        ->capture_default_str()
        ->group(output);
    command.add_flag("--overwrite", o.overwrite, "replace a finished frame in the folder")->group(output);
    command.add_option("--threads", o.threads, "0 = all; changes no byte")->capture_default_str()->group(output);
    command.add_option("--progress", o.progress, "bar, json or none, on stderr")->capture_default_str()->group(output);
    command.add_flag("--json", o.json, "print what was done as JSON on stdout")->group(output);
    for (CLI::Option* option : command.get_options()) {
        // A script may append options to a command line: of values given twice the last one wins.
        if (option->get_items_expected_max() <= 1) option->take_last();
        // Lists are written with commas, so that a list before the scene's name does not swallow it.
        else
            option->allow_extra_args(false);
    }
    command.footer("Example:\n  pluvia render lane.glb --camera front --rain 10,50 --hour 20 -o out/lane");
}

nlohmann::ordered_json to_json(const RenderOptions& o) {
    nlohmann::ordered_json j;
    const auto optional = [&](const char* key, const std::optional<double>& value) {
        if (value) j[key] = *value;
    };
    if (!o.variant.empty()) j["variant"] = o.variant;
    j["camera"] = o.camera, j["size"] = o.size, j["frame"] = o.frame, j["fps"] = o.fps;
    optional("focal-length", o.focal_length), optional("f-number", o.f_number), optional("focus", o.focus);
    j["shutter"] = o.shutter;
    if (!o.camera_velocity.empty()) j["camera-velocity"] = o.camera_velocity;
    j["spp"] = o.spp, j["bounces"] = o.bounces, j["seed"] = o.seed;
    if (o.texture_size) j["texture-size"] = *o.texture_size;
    if (!o.wet_wind.empty()) j["wet-wind"] = o.wet_wind;
    if (o.rain_seed) j["rain-seed"] = *o.rain_seed;
    if (!o.wind_travel.empty()) j["wind-travel"] = o.wind_travel;
    j["rain"] = o.rain, j["wind"] = o.wind, j["composition"] = o.composition;
    j["streak-gain"] = o.streak_gain, j["fog-beta"] = o.fog_beta;
    if (o.composition == "paper") j["streak-distance"] = o.streak_distance, j["streak-share"] = o.streak_share;
    if (!o.streaks.empty()) j["streaks"] = o.streaks.substr(o.streaks.find_last_of('/') + 1);
    j["streak-width"] = streak_width(o), j["veil"] = o.veil;
    j["wetness"] = o.wetness, j["puddles"] = o.puddles, j["ripples"] = o.ripples;
    add_json(j, o.light, !o.rain.empty());
    if (!o.layers.empty()) j["layers"] = o.layers;
    if (!o.labels.empty()) j["labels"] = o.labels.substr(o.labels.find_last_of('/') + 1);
    j["exposure"] = o.exposure, j["view"] = o.view;
    j["depth-encoding"] = o.depth_encoding, j["depth-max"] = o.depth_max;
    return j;
}

}  // namespace pluvia
