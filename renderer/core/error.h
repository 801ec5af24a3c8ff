// The one exception of the project: thrown while loading and checking, caught once in the program's main.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace pluvia {

/// Exit codes of the program; scripts rely on them.
enum class ExitCode {
    ok = 0,
    check_failed = 1,    // a comparison or check found a difference
    usage = 2,           // command line or configuration
    input = 3,           // a file is unreadable or unsupported
    render_failed = 4,   // invalid samples, out of memory, output not writable
    some_failed = 5,     // finished, but some items failed
    stopped_early = 75,  // interrupted; run again to finish
};

class Error : public std::runtime_error {
public:
    /// where: file, node, option or line; what: the fault with what was found and what was expected.
    Error(ExitCode code, const std::string& where, const std::string& what)
        : std::runtime_error(where + ": " + what), code_(code) {}

    ExitCode code() const { return code_; }

private:
    ExitCode code_;
};

inline Error usage_error(const std::string& where, const std::string& what) {
    return {ExitCode::usage, where, what};
}
inline Error input_error(const std::string& where, const std::string& what) {
    return {ExitCode::input, where, what};
}

}  // namespace pluvia
