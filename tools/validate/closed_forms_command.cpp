// pluvia validate closed-forms: scenes whose light is known on paper, as a table.
#include "renderer/core/error.h"
#include "tools/frame_file.h"
#include "tools/validate/closed_forms.h"
#include "tools/validate/validate_commands.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iostream>

namespace pluvia {
namespace {

struct ClosedFormOptions {
    std::vector<std::string> only;
    uint64_t seed = 1000;
    bool json = false;
};

nlohmann::ordered_json to_json(const ClosedFormResult& r) {
    return {
        {"quantity", r.quantity},   {"expected", r.expected}, {"got", r.got},      {"standard_error", r.standard_error},
        {"tolerance", r.tolerance}, {"sigmas", r.sigmas()},   {"pass", r.passed()}};
}

std::vector<const ClosedForm*> chosen(const std::vector<std::string>& names) {
    std::vector<const ClosedForm*> forms;
    std::vector<std::string> known;
    for (const ClosedForm& form : closed_forms()) {
        known.emplace_back(form.name);
        if (names.empty() || std::find(names.begin(), names.end(), form.name) != names.end()) forms.push_back(&form);
    }
    for (const std::string& name : names)
        if (std::find(known.begin(), known.end(), name) == known.end())
            throw usage_error(
                "--only", fmt::format("does not know this (got \"{}\", expected {})", name, fmt::join(known, ", ")));
    return forms;
}

void closed_forms_command(const ClosedFormOptions& options) {
    nlohmann::ordered_json json;
    json["version"] = PLUVIA_VERSION, json["seed"] = options.seed;
    if (!options.json)
        std::cout << fmt::format(
            "pluvia {}, seeds from {}; sigma: standard error in % of what is expected\n\n{:>11} {:>11} "
            "{:>7}  {:>4}        quantity\n",
            PLUVIA_VERSION, options.seed, "expected", "got", "sigma", "off");
    int failed = 0;
    for (const ClosedForm* form : chosen(options.only))
        for (const ClosedFormResult& r : form->measure(options.seed)) {
            failed += !r.passed();
            json[form->name].push_back(to_json(r));
            if (!options.json)
                std::cout << fmt::format("{:>11.6g} {:>11.6g} {:>7.4f}  {:>4.1f}  {}  {}\n", r.expected, r.got,
                                         100 * r.standard_error / std::abs(r.expected), r.sigmas(),
                                         r.passed() ? "pass" : "FAIL", r.quantity)
                          << std::flush;
        }
    if (options.json) std::cout << json_text(json, 2) << "\n";
    if (failed > 0)
        throw Error(ExitCode::check_failed, "validate closed-forms",
                    fmt::format("{} of the quantities {} not what {} should be", failed, failed == 1 ? "is" : "are",
                                failed == 1 ? "it" : "they"));
}

}  // namespace

void add_closed_forms_command(CLI::App& validate) {
    auto* command = validate.add_subcommand("closed-forms", "renders scenes whose light is known on paper");
    auto o = std::make_shared<ClosedFormOptions>();
    command->add_option("--only", o->only, "subjects, e.g. area-lights,drops; default: all")->delimiter(',');
    command->add_option("--seed", o->seed, "the first of the seeds that are averaged")->capture_default_str();
    command->add_flag("--json", o->json, "print as JSON on stdout");
    command->footer(
        "A quantity passes when it is within 5 sigma of what is expected, beyond what rounding and tables may add, "
        "and\n"
        "sigma is at most 0.1 % of it. `off` is the distance in sigmas. Exit code 1 when one does not.\n\n"
        "Example:\n  pluvia validate closed-forms --only punctual-lights,drops");
    command->callback([o] { closed_forms_command(*o); });
}

}  // namespace pluvia
