#include "tools/streak_cache.h"

#include "renderer/core/error.h"
#include "renderer/core/random.h"
#include "renderer/image/table_file.h"

#include <fmt/format.h>

#include <bit>
#include <mutex>

namespace pluvia {
namespace {

constexpr uint64_t version = 1;  // of what trace_streaks makes of its settings

uint64_t key_of(const StreakTracing& s) {
    return hash_key(0x73747265616b73, version, s.width, s.rays_per_pixel, s.seed,
                    std::bit_cast<uint32_t>(s.light_radius));
}

/// Calls visit(view, picture) for every picture of a database, in the order of the file.
template <class Database, class Visit>
void visit_pictures(Database& database, Visit&& visit) {
    for (auto& view : database.views) {
        for (auto& picture : view.pictures) visit(view, picture);
        for (auto& picture : view.ambient) visit(view, picture);
    }
}

StreakDatabase empty_database(const StreakTracing& settings) {
    StreakDatabase database;
    for (size_t v = 0; v < database.views.size(); ++v) {
        StreakDatabase::View& view = database.views[v];
        view.width = settings.width, view.height = streak_rows(int(v), settings.width);
        view.pictures.resize(size_t(streak_light_count) * streak_oscillations);
    }
    return database;
}

}  // namespace

StreakDatabase trace_streaks_with_progress(const StreakTracing& settings, Progress::Style style) {
    Progress progress(style, "raindrop streaks");
    std::mutex mutex;
    return trace_streaks(settings, [&](double done) {
        const std::lock_guard lock(mutex);
        if (!progress.update(done)) throw Error(ExitCode::stopped_early, "streaks", "stopped before the end");
    });
}

StreakDatabase cached_streaks(const StreakTracing& settings, Progress::Style style, const std::string& cache) {
    const uint64_t key = key_of(settings);
    const std::string path = fmt::format("{}/streaks-{:016x}.bin", cache, key);
    StreakDatabase database = empty_database(settings);
    size_t count = 0;
    visit_pictures(database, [&](auto& view, auto&) { count += 1 + size_t(view.width) * size_t(view.height); });
    if (!cache.empty()) {
        if (const auto values = read_table(path, key, count)) {
            const float* next = values->data();
            visit_pictures(database, [&](auto& view, StreakPicture& picture) {
                picture.factor = *next++;
                const size_t pixels = size_t(view.width) * size_t(view.height);
                picture.values.assign(next, next + pixels);
                next += pixels;
            });
            return database;
        }
    }
    database = trace_streaks_with_progress(settings, style);
    if (!cache.empty()) {
        std::vector<float> values;
        values.reserve(count);
        visit_pictures(database, [&](auto&, const StreakPicture& picture) {
            values.push_back(picture.factor);
            values.insert(values.end(), picture.values.begin(), picture.values.end());
        });
        write_table(path, key, values);
    }
    return database;
}

}  // namespace pluvia
