// Progress of long work on stderr: a bar with the time left on a terminal, a plain line every ten seconds elsewhere,
// or JSON lines for programs.
#pragma once

#include <chrono>
#include <string>

namespace pluvia {

class Progress {
public:
    enum class Style { bar, json, none };
    /// Throws Error (usage) for an unknown name.
    static Style style_from_name(const std::string& name);

    Progress(Style style, std::string title);
    /// Ends the bar's line.
    ~Progress();

    /// done: 0 to 1. Cheap enough to be called for every tile. False after the user has interrupted the program.
    bool update(double done);

private:
    using Clock = std::chrono::steady_clock;
    Style style_;
    std::string title_;
    bool terminal_, drawn_ = false, complete_ = false;
    Clock::time_point start_ = Clock::now(), last_ = start_;
};

/// Makes the first interrupt, termination or user signal (SIGINT, SIGTERM, SIGUSR1, which batch systems send ahead of
/// the end) a request to stop, seen by Progress::update; a second one kills.
void catch_interrupts();

}  // namespace pluvia
