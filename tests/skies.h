// Tables of the standard atmosphere for the tests that only use them, as the program keeps them.
#pragma once

#include "tools/sky_cache.h"

namespace pluvia {

inline const SkyTables& standard_sky_tables() {
    static const SkyTables tables = cached_sky_tables({});
    return tables;
}

}  // namespace pluvia
