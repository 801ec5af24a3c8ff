// The streak database as the program gets it: from a folder of the user's, from the user's cache, or traced.
#pragma once

#include "shaders/streak_tracing.h"
#include "tools/progress.h"
#include "tools/sky_cache.h"

#include <string>

namespace pluvia {

/// trace_streaks with a bar on stderr. Throws Error (stopped_early) after an interrupt.
StreakDatabase trace_streaks_with_progress(const StreakTracing& settings, Progress::Style style);

/// Read from a file in `cache` if it holds it unharmed; else traced, in some ten seconds on two cores, and kept there.
/// That the folder cannot be written is no error. cache empty: no file.
StreakDatabase cached_streaks(const StreakTracing& settings, Progress::Style style,
                              const std::string& cache = cache_folder());

}  // namespace pluvia
