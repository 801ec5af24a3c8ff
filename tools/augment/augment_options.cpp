#include "tools/augment/augment_options.h"

namespace pluvia {

void add_augment_options(CLI::App& command, AugmentOptions& o) {
    RenderOptions& r = o.render;
    command.add_option("input", o.input, "folder of the data set")->required();
    command.add_option("-o,--output", r.output, "folder for what is made")->required();

    const auto* input = "Pictures";
    command.add_option("--dataset", o.dataset, "how the input is laid out: folder, carla, kitti, cityscapes, nuscenes")
        ->capture_default_str()
        ->group(input);
    command.add_option("--images", o.images, "folder, carla: pictures, e.g. 'rgb/*.png'; * is any text in a name")
        ->group(input);
    command
        .add_option("--depth", o.depth, "folder, carla: their depth, e.g. 'depth/*.png'; with as many * as --images")
        ->group(input);
    command
        .add_option("--labels", o.labels,
                    "folder, carla: files that are copied unchanged, e.g. 'semantic/*.png'; not with --delta-only")
        ->group(input);
    command
        .add_option("--depth-encoding", o.depth_encoding,
                    "kitti16 (metres * 256), mm16 (millimetres), carla24, carla-log (CARLA's 8 bits, logarithmic), "
                    "carla (either), metres (EXR or NPY), disparity (Cityscapes' 16 bits); along the view axis")
        ->group(input);
    command
        .add_option("--calibration", o.calibration,
                    "folder, carla: JSON file with the cameras as frame.json has them: {\"camera\": {...}}, or "
                    "{\"cameras\": {\"NAME\": {...}}} by name of the picture without its extension")
        ->group(input);
    command.add_option("--fov", o.fov, "degrees across the picture; carla: 90")->group(input);
    command.add_option("--focal-length", r.focal_length, "mm on a sensor 36 mm wide, in place of --fov")->group(input);
    command.add_option("--baseline", o.baseline, "metres between the stereo cameras, for disparity")->group(input);
    command.add_option("--curve", o.curve, "of 8 and 16 bit pictures: srgb or linear; EXR and HDR hold light as it is")
        ->capture_default_str()
        ->group(input);
    command
        .add_option(
            "--exposure", r.exposure,
            "EV at ISO 100 that the pictures were taken at; auto: what an EXR file says, else such that a day's sky "
            "has 4000 cd/m2, a day's street without sky 1300, a night's 1 (night: the sky below 10 % of white and "
            "darker "
            "than the street, or a picture without sky below 5 %). It decides over cd/m2 alone, so only where "
            "--environment brings light of its own")
        ->capture_default_str()
        ->group(input);

    add_rain_options(command, r);
    command
        .add_option("--environment", r.light.environment,
                    "HDR or EXR file, equirectangular, or R,G,B in cd/m2: light on the drops from where the pictures "
                    "show nothing; default: estimated from each picture")
        ->group("Light");

    const auto* camera = "Camera";
    command.add_option("--f-number", r.f_number, "lens opening; default: pinhole")->group(camera);
    command.add_option("--focus", r.focus, "metres in focus [10]; needs --f-number")->group(camera);
    command.add_option("--shutter", r.shutter, "exposure time in seconds, which makes the streaks")
        ->capture_default_str()
        ->group(camera);
    command
        .add_option("--camera-velocity", r.camera_velocity,
                    "X,Y,Z in m/s, Y up, the camera looking along -Z; slants the streaks")
        ->delimiter(',')
        ->expected(3)
        ->group(camera);

    const auto* quality = "Accuracy";
    const CLI::Validator seed_range = CLI::Range(0.0, 0x1p64 * (1 - 0x1p-53)).description("");
    command.add_option("--spp", r.spp, "samples per pixel")->capture_default_str()->group(quality);
    command
        .add_option(
            "--veil", r.veil,
            "light of rain too fine for streaks, of drops narrower than a pixel and of the paper's streaks: table, "
            "interpolated between some thousand places of the view, quick and smooth but BIASED: by 1 % of this "
            "light, by more in the darkest parts, where there is little, and halos of lamps are 1/64 of the "
            "picture wide at least; or traced. With fog always traced")
        ->capture_default_str()
        ->group(quality);
    command.add_option("--seed", r.seed, "of all random numbers")
        ->check(seed_range)
        ->capture_default_str()
        ->group(quality);

    const auto* output = "Output";
    command.add_flag("--exr", o.exr, "also write all layers of each picture, 32-bit float")->group(output);
    command
        .add_flag("--delta-only", o.delta_only,
                  "nothing that shows the input: layers as EXR, for data that may not be passed on; "
                  "rainy = picture * transmittance + rain + inscatter, in linear light")
        ->group(output);
    command.add_option("--shard", o.shard, "I/N: the I-th of N parts of the pictures")
        ->capture_default_str()
        ->group(output);
    command.add_flag("--dry-run", o.dry_run, "list the pictures and make nothing")->group(output);
    command.add_option("--threads", r.threads, "0 = all; changes no byte")->capture_default_str()->group(output);
    command.add_option("--progress", r.progress, "bar, json or none, on stderr")->capture_default_str()->group(output);
    command.add_flag("--json", r.json, "print what was done as JSON on stdout")->group(output);
    for (CLI::Option* option : command.get_options()) {
        if (option->get_items_expected_max() <= 1) option->take_last();
        // Lists are written with commas, so that a list before the input's name does not swallow it.
        else
            option->allow_extra_args(false);
    }
    command.footer(
        "Depth: pixels without one take that of the nearest pixel that has one; where more than half have one, those\n"
        "that reach the top edge are sky. Both are counted. No rain is kept away by roofs that a picture shows.\n"
        "Pictures whose cameras --calibration or the data set places in one world see the same drops; any other sees\n"
        "drops of its own. A run may be stopped and started again.\n"
        "Example:\n  pluvia augment extremerain -o out/rain --dataset carla --rain 5,50,100");
}

nlohmann::ordered_json to_json(const AugmentOptions& o) {
    const RenderOptions& r = o.render;
    nlohmann::ordered_json j;
    j["dataset"] = o.dataset;
    j["curve"] = o.curve, j["exposure"] = r.exposure;
    if (!o.depth_encoding.empty()) j["depth-encoding"] = o.depth_encoding;
    const auto optional = [&](const char* key, const std::optional<double>& value) {
        if (value) j[key] = *value;
    };
    optional("fov", o.fov), optional("baseline", o.baseline);
    optional("focal-length", r.focal_length), optional("f-number", r.f_number), optional("focus", r.focus);
    j["shutter"] = r.shutter;
    if (!r.camera_velocity.empty()) j["camera-velocity"] = r.camera_velocity;
    j["spp"] = r.spp, j["veil"] = r.veil, j["seed"] = r.seed;
    j["rain"] = r.rain, j["wind"] = r.wind, j["composition"] = r.composition;
    j["streak-gain"] = r.streak_gain, j["fog-beta"] = r.fog_beta;
    if (r.composition == "paper") j["streak-distance"] = r.streak_distance, j["streak-share"] = r.streak_share;
    if (!r.streaks.empty()) j["streaks"] = r.streaks.substr(r.streaks.find_last_of('/') + 1);
    j["streak-width"] = streak_width(r);
    if (!r.light.environment.empty())
        j["environment"] = r.light.environment.substr(r.light.environment.find_last_of('/') + 1);
    j["exr"] = o.exr, j["delta-only"] = o.delta_only;
    return j;
}

}  // namespace pluvia
