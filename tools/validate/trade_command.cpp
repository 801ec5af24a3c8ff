// pluvia validate trade: what the accuracy of a frame costs, dial by dial.
#include "renderer/core/error.h"
#include "renderer/core/parallel.h"
#include "renderer/core/random.h"
#include "tools/dataset/file_hash.h"
#include "tools/progress.h"
#include "tools/validate/trade_dials.h"
#include "tools/validate/trade_reference.h"
#include "tools/validate/trade_report.h"
#include "tools/validate/validate_commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iostream>

namespace pluvia {
namespace {

struct TradeOptions {
    RenderOptions frame;
    int reference_samples = 2048;
    std::vector<std::string> only;
};

/// Of an earlier run that was perhaps interrupted; none where there is no such file or it cannot be read.
std::vector<TradeResult> earlier_results(const std::string& path) {
    std::ifstream file(path);
    if (!file) return {};
    try {
        return trade_results(nlohmann::ordered_json::parse(file));
    } catch (const std::exception&) {
        std::cerr << "pluvia: warning: " << path << ": is no report of validate trade and is replaced\n";
        return {};
    }
}

/// Of all that a setting's numbers depend on.
uint64_t setting_key(const TradeScene& scene, const TradeSetting& setting, const RenderOptions& options,
                     const TradeReference& reference) {
    return hash_key(scene.key(), hash_text(setting.dial + "=" + setting.value), hash_text(json_text(to_json(options))),
                    reference.samples);
}

TradeResult measure(const TradeScene& scene, const TradeSetting& setting, const RenderOptions& options, uint64_t key,
                    const TradeReference& reference, const ProgressCallback& progress) {
    RenderSettings settings = render_settings(options);
    settings.streaks.textures = streak_textures(options);
    if (setting.code) setting.code(settings);
    TradeResult result{setting.dial, setting.value, setting.biased, key};
    const std::optional<TradeScene> other = setting.reloads ? std::optional<TradeScene>(options) : std::nullopt;
    const JudgedLayers got = (other ? *other : scene).render(settings, options.target_error, result, progress);
    result.background = error_of_layer(got.background, reference.layers.background);
    if (got.rainy) result.rainy = error_of_layer(*got.rainy, *reference.layers.rainy);
    return result;
}

void trade_command(const TradeOptions& o) {
    const auto style = Progress::style_from_name(o.frame.progress);
    const RenderSettings base = render_settings(o.frame);
    set_thread_count(o.frame.threads);
    check_dials(o.only);
    const auto settings = trade_settings(!o.frame.rain.empty(), o.frame.composition == "physical");
    catch_interrupts();
    const TradeScene scene(o.frame);
    TradeReference reference;
    {
        Progress progress(style, "reference");
        reference = find_reference(scene, base, o.reference_samples, o.frame.output,
                                   [&](double done) { return progress.update(done); });
    }
    const std::string path = o.frame.output + "/trade.json";
    const std::vector<TradeResult> earlier = earlier_results(path);
    TradeReport report{o.frame.scene, to_json(o.frame), reference.samples, reference.error, {}};
    const auto save = [&] {
        write_text(path, json_text(trade_json(report), 2) + "\n");
        write_text(o.frame.output + "/trade.html", trade_page(report));
    };
    for (size_t i = 0; i < settings.size(); ++i) {
        RenderOptions options = o.frame;
        options.seed += 1;  // none of the samples of a frame that --seed may make, so that it can be compared too
        options.rain_seed = o.frame.rain_seed.value_or(o.frame.seed);
        if (settings[i].options) settings[i].options(options);
        const uint64_t key = setting_key(scene, settings[i], options, reference);
        const auto done = std::find_if(earlier.begin(), earlier.end(), [&](const auto& r) { return r.key == key; });
        if (done != earlier.end()) {
            report.results.push_back(*done);
            continue;
        }
        if (!o.only.empty() && std::find(o.only.begin(), o.only.end(), settings[i].dial) == o.only.end()) continue;
        Progress progress(style,
                          fmt::format("{} of {}: {} {}", i + 1, settings.size(), settings[i].dial, settings[i].value));
        report.results.push_back(
            measure(scene, settings[i], options, key, reference, [&](double share) { return progress.update(share); }));
        save();
    }
    save();
    std::cout << (o.frame.json ? json_text(trade_json(report), 2) + "\n" : trade_table(report));
}

std::string dial_list() {
    std::string text = "Dials:\n";
    for (const TradeDial& dial : trade_dials()) text += fmt::format("  {:<16} {}\n", dial.name, dial.meaning);
    return text;
}

}  // namespace

void add_trade_command(CLI::App& validate) {
    auto* command = validate.add_subcommand("trade", "what accuracy costs: a frame at many settings, time and error");
    auto o = std::make_shared<TradeOptions>();
    o->frame.size = "256x128", o->frame.spp = 16;
    add_render_options(*command, o->frame);
    command->get_option("--output")->description("folder for trade.json, trade.html and the reference");
    command->get_option("--spp")->description("samples per pixel of settings of other dials");
    command
        ->add_option("--reference-spp", o->reference_samples,
                     "samples per pixel of the reference, in batches of 128 that are kept: more of them add to it")
        ->check(CLI::Range(1, 1 << 20).description(""))
        ->capture_default_str();
    command->add_option("--only", o->only, "dials, e.g. samples,bounces; default: all")
        ->delimiter(',')
        ->allow_extra_args(false);
    command->footer(dial_list() +
                    "\nWhat is done is not done again: the command goes on where it was stopped.\n\n"
                    "Example:\n  pluvia validate trade lane.glb --camera mid --rain 50 --hour 20 -o out/trade");
    command->callback([o] { trade_command(*o); });
}

}  // namespace pluvia
