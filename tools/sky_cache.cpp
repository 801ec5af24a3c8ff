#include "tools/sky_cache.h"

#include "renderer/image/table_file.h"

#include <fmt/format.h>

#include <cstdlib>

namespace pluvia {

std::string cache_folder() {
    // A relative path is invalid there and to be ignored; XDG Base Directory
    // Specification 0.8.
    const char* cache = std::getenv("XDG_CACHE_HOME");
    if (cache && cache[0] == '/') return std::string(cache) + "/pluvia";
    const char* home = std::getenv("HOME");
    return home && home[0] == '/' ? std::string(home) + "/.cache/pluvia" : std::string();
}

SkyTables cached_sky_tables(const AtmosphereSettings& settings, const std::string& folder) {
    const uint64_t key = sky_tables_key(settings);
    const std::string path = fmt::format("{}/sky-{:016x}.bin", folder, key);
    if (folder.empty()) return make_sky_tables(settings);
    if (const auto values = read_table(path, key, sky_value_count())) return tables_from_values(settings, *values);
    SkyTables tables = make_sky_tables(settings);
    write_table(path, key, values_of(tables));
    return tables;
}

}  // namespace pluvia
