// Tables of the atmosphere as the program gets them: from the user's cache, or
// made anew.
#pragma once

#include "shaders/sky_tables.h"

#include <string>

namespace pluvia {

/// Folder of Pluvia's cache: $XDG_CACHE_HOME/pluvia, else $HOME/.cache/pluvia;
/// empty when neither is set.
std::string cache_folder();

/// Read from a file in `folder` if it holds them unharmed; else made, in about
/// a second on two cores, and written there. That the folder cannot be written
/// is no error. folder empty: no file.
SkyTables cached_sky_tables(const AtmosphereSettings& settings, const std::string& folder = cache_folder());

}  // namespace pluvia
