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

}  // namespace pluvia
