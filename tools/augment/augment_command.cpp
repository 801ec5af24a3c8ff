#include "renderer/core/error.h"
#include "renderer/core/parallel.h"
#include "tools/augment/augment_item.h"
#include "tools/commands.h"
#include "tools/dataset/record.h"
#include "tools/dataset/run_log.h"
#include "tools/dataset/work_folder.h"
#include "tools/option_check.h"
#include "tools/progress.h"

#include <chrono>
#include <filesystem>
#include <iostream>

namespace pluvia {
namespace {

struct AugmentResult {
    size_t pictures = 0, already_done = 0, made = 0, failed = 0;
};

AugmentResult augment_all(const std::vector<AugmentItem>& items, const AugmentSettings& settings, Shard shard) {
    const RenderOptions& options = settings.options.render;
    const WorkFolder work(options.output, shard);
    RunLog log(options.output, shard);
    Progress progress(Progress::style_from_name(options.progress), "augment");
    AugmentResult result;
    result.pictures = items.size();
    for (size_t i = 0; i < items.size(); ++i) {
        const AugmentItem& item = items[i];
        const std::string hash = settings_hash(item, settings.options);
        if (is_done(options.output, item.record_path(), hash)) {
            ++result.already_done;
            progress.update(double(i + 1) / double(items.size()));
            continue;
        }
        const std::string scratch = work.path() + "/picture";
        std::filesystem::create_directory(scratch);
        const auto start = std::chrono::steady_clock::now();
        try {
            augment_item(item, settings, scratch, hash,
                         [&](double share) { return progress.update((double(i) + share) / double(items.size())); });
            ++result.made;
            log.add_done(item.name, settings.options.dataset,
                         std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
        } catch (const Error& e) {
            if (e.code() == ExitCode::stopped_early)
                throw Error(ExitCode::stopped_early, options.output,
                            fmt::format("stopped; {} of {} pictures are done, run again to go on",
                                        result.already_done + result.made, items.size()));
            // The picture's own files; the next one may be well.
            if (e.code() != ExitCode::some_failed && e.code() != ExitCode::input) throw;
            ++result.failed;
            log.add_failed(item.name, settings.options.dataset, e.what());
            std::cerr << "pluvia: error: " << e.what() << "\n";
        }
        std::filesystem::remove_all(scratch);
    }
    return result;
}

void augment_command(const AugmentOptions& options) {
    const AugmentSettings settings(options);
    Progress::style_from_name(options.render.progress);
    set_thread_count(options.render.threads);
    const Shard shard = Shard::parse(options.shard);
    std::vector<AugmentItem> items = augment_items(options);
    const auto [begin, end] = shard.range(items.size());
    items = {items.begin() + long(begin), items.begin() + long(end)};
    if (options.dry_run) {
        for (const AugmentItem& item : items)
            std::cout << item.name << "\t" << item.picture << "\t" << item.depth << "\n";
        return;
    }
    catch_interrupts();
    const AugmentResult r = augment_all(items, settings, shard);
    const std::string& output = options.render.output;
    if (options.render.json)
        std::cout << nlohmann::ordered_json{{"output", output},
                                            {"pictures", r.pictures},
                                            {"already_done", r.already_done},
                                            {"made", r.made},
                                            {"failed", r.failed}}
                         .dump(2)
                  << "\n";
    else
        std::cout << fmt::format("{}: {} pictures made, {} were done already, {} failed\n", output, r.made,
                                 r.already_done, r.failed);
    if (r.failed > 0 && r.failed == r.pictures)
        throw input_error(options.input, fmt::format("none of {} pictures could be read", r.pictures));
    if (r.failed > 0)
        throw Error(ExitCode::some_failed, output,
                    fmt::format("{} of {} pictures failed; logs/ names them", r.failed, r.pictures));
}

}  // namespace

void add_augment_command(CLI::App& app) {
    auto* command = app.add_subcommand("augment", "rain on pictures that already exist, with their depth");
    auto options = std::make_shared<AugmentOptions>();
    add_augment_options(*command, *options);
    command->callback([options] { augment_command(*options); });
}

}  // namespace pluvia
