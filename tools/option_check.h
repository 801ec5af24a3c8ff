// How options are checked: one sentence that names the option, what was given and what is expected.
#pragma once

#include "renderer/core/error.h"

#include <fmt/format.h>

#include <charconv>
#include <string>
#include <string_view>

namespace pluvia {

/// Throws Error (usage). option: without its dashes.
[[noreturn]] inline void fail_option(const std::string& option, const std::string& got, const std::string& expected) {
    throw usage_error("--" + option, fmt::format("is not valid (got {}, expected {})", got, expected));
}

inline void require_option(bool ok, const std::string& option, double got, const std::string& expected) {
    if (!ok) fail_option(option, fmt::format("{}", got), expected);
}

/// True when all of the text is a number.
bool parse_number(std::string_view text, auto& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size();
}

}  // namespace pluvia
