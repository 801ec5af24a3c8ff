// The streak database as files, in the layout in which Garg and Nayar published theirs: 16-bit PNG of a streak scaled
// to its maximum, and text files of those maxima, which all sizes share.
//   env_light_database/size16/cv0_osc0.png                     env_light_database/txt/normalized_env_max.txt
//   point_light_database/size16/dcam00/cv0_v-10_h30_osc0.png   point_light_database/txt/dcam00_point_max.txt
#pragma once

#include "shaders/streak_database.h"

#include <functional>
#include <string>
#include <vector>

namespace pluvia {

/// Writes the same database at several widths, all with the same factors, into a folder that does not exist yet; it
/// appears whole. progress: as trace_streaks. Throws Error (usage) when there is something of that name,
/// (render_failed) when it cannot be written.
void write_streaks(const std::string& folder, const std::vector<StreakDatabase>& widths,
                   const std::function<void(double)>& progress);

/// Reads Pluvia's database or the published one at a width. Of the published one the sides are found by their light:
/// a drop is brighter with the light behind it. Throws Error (input) with the file that is missing, truncated or
/// different from the others. width: pixels; 0 = the first there is of 16, 8, 32, 4.
StreakDatabase read_streaks(const std::string& folder, int width = 0);

}  // namespace pluvia
