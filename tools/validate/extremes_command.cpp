// pluvia validate extremes: hard cases as a table.
#include "renderer/core/error.h"
#include "tools/frame_file.h"
#include "tools/validate/extremes.h"
#include "tools/validate/validate_commands.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iostream>

namespace pluvia {
namespace {

struct ExtremeOptions {
    std::vector<std::string> only;
    bool short_form = false, json = false;
};

void check_names(const std::vector<std::string>& names) {
    std::vector<std::string> known;
    for (const ExtremeSubject& subject : extreme_subjects()) known.emplace_back(subject.name);
    for (const std::string& name : names)
        if (std::find(known.begin(), known.end(), name) == known.end())
            throw usage_error(
                "--only", fmt::format("does not know this (got \"{}\", expected {})", name, fmt::join(known, ", ")));
}

void extremes_command(const ExtremeOptions& options) {
    check_names(options.only);
    nlohmann::ordered_json json;
    json["version"] = PLUVIA_VERSION;
    if (!options.json)
        std::cout << fmt::format("pluvia {}\n\n{:>13} {:>13} {:>9}\n", PLUVIA_VERSION, "expected", "got", "within");
    int failed = 0;
    for (const ExtremeSubject& subject : extreme_subjects()) {
        if (!options.only.empty() &&
            std::find(options.only.begin(), options.only.end(), subject.name) == options.only.end())
            continue;
        if (!options.json) std::cout << subject.name << "\n" << std::flush;
        for (const ExtremeResult& r : subject.measure(!options.short_form)) {
            failed += !r.passed();
            const double within = r.tolerance + 5 * r.standard_error;
            if (options.json)
                json[subject.name].push_back({{"quantity", r.quantity},
                                              {"expected", r.expected},
                                              {"got", r.got},
                                              {"tolerance", r.tolerance},
                                              {"standard_error", r.standard_error},
                                              {"pass", r.passed()}});
            else
                std::cout << fmt::format("{:>13.8g} {:>13.8g} {:>9.2g}  {}  {}\n", r.expected, r.got, within,
                                         r.passed() ? "pass" : "FAIL", r.quantity)
                          << std::flush;
        }
    }
    if (options.json) std::cout << json_text(json, 2) << "\n";
    if (failed > 0)
        throw Error(ExitCode::check_failed, "validate extremes",
                    fmt::format("{} of the cases {} not what {} should be", failed, failed == 1 ? "is" : "are",
                                failed == 1 ? "it" : "they"));
}

}  // namespace

void add_extremes_command(CLI::App& validate) {
    auto* command = validate.add_subcommand("extremes", "settings and scenes at the ends of what is allowed");
    auto o = std::make_shared<ExtremeOptions>();
    command->add_option("--only", o->only, "subjects, e.g. rain,lamps; default: all")->delimiter(',');
    command->add_flag("--short", o->short_form, "leave out the cases that take long or much memory");
    command->add_flag("--json", o->json, "print as JSON on stdout");
    command->footer(
        "Each case has a value that physics or arithmetic says must come out; `within` is the tolerance, with five\n"
        "standard errors where the value is a mean over seeds. A picture with a negative value, one that is not a\n"
        "number or a lost sample fails whatever its mean. Exit code 1 when a case fails.\n\n"
        "Example:\n  pluvia validate extremes --only scale,geometry");
    command->callback([o] { extremes_command(*o); });
}

}  // namespace pluvia
