#include "tools/progress.h"

#include "renderer/core/error.h"

#include <fmt/format.h>

#include <unistd.h>
#include <csignal>
#include <cstdio>

namespace pluvia {
namespace {

volatile std::sig_atomic_t interrupted = 0;

std::string clock_text(double seconds) {
    const long s = std::lround(seconds);
    return s >= 3600 ? fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60)
                     : fmt::format("{}:{:02}", s / 60, s % 60);
}

}  // namespace

void catch_interrupts() {
    struct sigaction action = {};
    action.sa_handler = [](int) { interrupted = 1; };
    action.sa_flags = SA_RESETHAND;
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    sigaction(SIGUSR1, &action, nullptr);
}

Progress::Style Progress::style_from_name(const std::string& name) {
    if (name == "bar") return Style::bar;
    if (name == "json") return Style::json;
    if (name == "none") return Style::none;
    throw usage_error("--progress", fmt::format("is not valid (got \"{}\", expected bar, json or none)", name));
}

Progress::Progress(Style style, std::string title)
    : style_(style), title_(std::move(title)), terminal_(isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
    if (drawn_ && style_ == Style::bar && terminal_) fmt::print(stderr, "\n");
}

bool Progress::update(double done) {
    if (interrupted) return false;
    const auto now = Clock::now();
    const double since_last = std::chrono::duration<double>(now - last_).count();
    const bool due = style_ == Style::bar && !terminal_ ? since_last >= 10 : since_last >= 0.2;
    if (style_ == Style::none || complete_ || (!due && done < 1)) return true;
    complete_ = done >= 1;
    last_ = now;
    const double elapsed = std::chrono::duration<double>(now - start_).count();
    const double left = done > 0 ? elapsed / done * (1 - done) : 0;
    if (style_ == Style::json) {
        fmt::print(stderr, "{{\"progress\": {:.4f}, \"elapsed_s\": {:.1f}, \"left_s\": {:.1f}}}\n", done, elapsed,
                   left);
    } else if (terminal_) {
        constexpr int width = 40;
        const int filled = int(done * width);
        fmt::print(stderr, "\r{} [{}{}] {:3.0f} %  {} left \033[K", title_, std::string(filled, '#'),
                   std::string(width - filled, '.'), 100 * done, clock_text(left));
        std::fflush(stderr);
        drawn_ = true;
    } else {
        fmt::print(stderr, "{}: {:.0f} %, {} elapsed, {} left\n", title_, 100 * done, clock_text(elapsed),
                   clock_text(left));
    }
    return true;
}

}  // namespace pluvia
