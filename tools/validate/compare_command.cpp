// pluvia validate compare: options to settings, findings to stdout and files.
#include "renderer/core/error.h"
#include "tools/frame_file.h"
#include "tools/validate/compare_report.h"
#include "tools/validate/html_report.h"
#include "tools/validate/validate_commands.h"

#include <fmt/format.h>

#include <cmath>
#include <iostream>

namespace pluvia {
namespace {

struct CompareOptions {
    std::string a, b;
    std::vector<std::string> layers, regions, limits;
    std::string kind = "auto", depth_encoding = "kitti16", html;
    double depth_max = 100, pixels_per_degree = flip_pixels_per_degree;
    std::optional<double> white;
    bool json = false, without_flip = false;
};

std::string definitions() {
    return "Metrics (A is judged, B is the reference):\n" + metric_definitions() +
           "Light (EXR, HDR) is displayed by dividing by --white, clipping to 0..1 and the sRGB curve; pictures of 8 "
           "or\n"
           "16 bits are taken as stored, divided by 255 or 65535, for all metrics. Depth needs values that are finite "
           "and\n"
           "above 0; a mask is set from one half on. LPIPS and FID are not computed: they are numbers of trained "
           "networks\n"
           "whose weights do not come with Pluvia, and nothing else goes by their names.\n\n"
           "Layers of EXR files: without --layer the picture itself, in files of Pluvia (background), Mitsuba and "
           "pbrt\n"
           "(R, G, B) and Cycles (ViewLayer.Combined); `depth` and `distance` find it under each of their names.\n"
           "In folders files of the same relative path are compared; names with `mask` are masks, those that begin\n"
           "with `depth` are depth.\n\n"
           "Exit code 1 when a --fail limit is passed by any picture or region.\n\n"
           "Example:\n  pluvia validate compare out/wet/frame.exr out/wet/frame.exr --layer rainy_100:background "
           "--html out/rain.html";
}

void compare_command(const CompareOptions& options) {
    CompareSettings settings;
    settings.read.kind = options.kind;
    settings.read.depth_encoding = depth_encoding_from_name(options.depth_encoding, "--depth-encoding");
    settings.read.depth_max = float(options.depth_max);
    if (!options.layers.empty()) settings.layers = options.layers;
    for (const std::string& text : options.regions) settings.regions.push_back(parse_region(text));
    std::vector<MetricLimit> limits;
    for (const std::string& text : options.limits) limits.push_back(parse_limit(text));
    settings.white = options.white;
    if (options.white && !(*options.white > 0 && std::isfinite(*options.white)))
        throw usage_error("--white", fmt::format("is no light (got {}, expected above 0)", *options.white));
    if (!(options.pixels_per_degree >= 1 && options.pixels_per_degree <= 1000))
        throw usage_error("--pixels-per-degree",
                          fmt::format("is out of range (got {}, expected 1 to 1000)", options.pixels_per_degree));
    settings.pixels_per_degree = options.pixels_per_degree;
    settings.flip = !options.without_flip;

    HtmlReport report;
    const auto pairs = compare(options.a, options.b, settings, [&](const ComparedPair& pair) {
        if (!options.html.empty()) report.add(pair);
    });
    const auto beyond = beyond_limits(pairs, limits);
    if (!options.html.empty()) report.write(options.html, options.a, options.b, pairs);
    if (options.json)
        std::cout << json_text(compare_json(options.a, options.b, pairs), 2) << "\n";
    else
        std::cout << compare_table(options.a, options.b, pairs);
    if (beyond.empty()) return;
    for (const std::string& line : beyond) std::cerr << line << "\n";
    throw Error(ExitCode::check_failed, "validate compare",
                fmt::format("{} {} beyond {}", beyond.size(), beyond.size() == 1 ? "value is" : "values are",
                            limits.size() == 1 ? "the limit" : "their limits"));
}

}  // namespace

void add_compare_command(CLI::App& validate) {
    auto* command = validate.add_subcommand("compare", "two pictures or folders: error metrics, error maps, limits");
    auto o = std::make_shared<CompareOptions>();
    command->add_option("A", o->a, "picture or folder that is judged")->required();
    command->add_option("B", o->b, "its reference")->required();
    command->add_option("--layer", o->layers, "of EXR files, NAME or NAME_IN_A:NAME_IN_B; may be given several times")
        ->allow_extra_args(false);
    command->add_option("--region", o->regions, "NAME=X,Y,WIDTH,HEIGHT in pixels from the upper left; several times")
        ->allow_extra_args(false);
    command->add_option("--as", o->kind, "what the files are: auto, color, depth or mask")
        ->check(CLI::IsMember({"auto", "color", "depth", "mask"}))
        ->capture_default_str();
    command->add_option("--depth-encoding", o->depth_encoding, "of integer depth: kitti16, mm16, carla24, hri")
        ->capture_default_str();
    command->add_option("--depth-max", o->depth_max, "metres of a full value in the encoding hri")
        ->check(CLI::PositiveNumber.description(""))
        ->capture_default_str();
    command->add_option(
        "--white", o->white,
        "light that displays as white, for PSNR, SSIM and FLIP; default: 98th percentile of B's luminance");
    command
        ->add_option("--pixels-per-degree", o->pixels_per_degree,
                     "of the eye's view, for FLIP; default: a 4K screen of 0.7 m seen from 0.7 m")
        ->capture_default_str();
    command->add_flag("--no-flip", o->without_flip, "leave out FLIP, which takes most of the time");
    command->add_option("--fail", o->limits, "METRIC=VALUE: exit code 1 when a metric is worse; several times")
        ->allow_extra_args(false);
    command->add_option("--html", o->html, "write the comparison with its pictures into one HTML file");
    command->add_flag("--json", o->json, "print as JSON on stdout");
    command->footer(definitions());
    command->callback([o] { compare_command(*o); });
}

}  // namespace pluvia
