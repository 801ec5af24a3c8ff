// What the system's clocks show, processor time included.
#pragma once

#include <ctime>

namespace pluvia {

/// Seconds of a clock of clock_gettime(2).
inline double clock_seconds(clockid_t clock) {
    timespec time = {};
    clock_gettime(clock, &time);
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

/// A time by the clock on the wall, and what all threads of this process worked in it; seconds.
struct SpentTime {
    double wall = 0, processor = 0;

    friend SpentTime operator+(SpentTime a, SpentTime b) { return {a.wall + b.wall, a.processor + b.processor}; }
    friend SpentTime operator-(SpentTime a, SpentTime b) { return {a.wall - b.wall, a.processor - b.processor}; }
    friend SpentTime operator*(SpentTime a, double s) { return {a.wall * s, a.processor * s}; }
};
/// Since some moment in the past: differences count.
inline SpentTime spent_time() {
    return {clock_seconds(CLOCK_MONOTONIC), clock_seconds(CLOCK_PROCESS_CPUTIME_ID)};
}

}  // namespace pluvia
