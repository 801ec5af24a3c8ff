#include "shaders/streak_files.h"

#include "renderer/core/error.h"
#include "renderer/core/parallel.h"
#include "renderer/image/image_io.h"
#include "renderer/image/pending_file.h"

#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <filesystem>
#include <sstream>

namespace pluvia {
namespace {

namespace fs = std::filesystem;

std::string ambient_folder(int width) {
    return fmt::format("/env_light_database/size{}", width);
}
std::string point_folder(int width, int view) {
    return fmt::format("/point_light_database/size{}/dcam{:02}", width, view);
}
const char* const ambient_text = "/env_light_database/txt/normalized_env_max.txt";
std::string point_text(int view) {
    return fmt::format("/point_light_database/txt/dcam{:02}_point_max.txt", view);
}

std::string ambient_name(int view, int oscillation) {
    return fmt::format("/cv{}_osc{}.png", view, oscillation);
}
std::string point_name(int view, StreakLight light, int oscillation) {
    return fmt::format("/cv{}_v{}_h{}_osc{}.png", view, streak_elevations[size_t(light.elevation)],
                       streak_azimuths[size_t(light.azimuth)], oscillation);
}

void write_picture(const std::string& path, const StreakPicture& picture, int width, int height) {
    PngWriter writer(path, width, height, 1, 16);
    writer.write_rows(0, height, picture.values.data());
    writer.finish();
}

/// Factors of one direction; every number is followed by a blank, as in the published files.
template <class Factor>
std::string factor_line(Factor&& factor) {
    std::string line;
    for (int k = 0; k < streak_oscillations; ++k) line += fmt::format("{:.9g} ", factor(k));
    return line + "\n";
}

void write_file(const std::string& path, const std::string& text) {
    PendingFile file(path);
    file.stream() << text;
    file.commit();
}

void write_factors(const std::string& folder, const StreakDatabase& database) {
    std::string ambient;
    for (size_t v = 0; v < streak_views.size(); ++v) {
        const StreakDatabase::View& view = database.views[v];
        ambient += fmt::format("cv{}\n", streak_views[v]);
        ambient += factor_line([&](int k) { return view.ambient[size_t(k)].factor; });
        std::string points = fmt::format("cv{}\n", streak_views[v]);
        for (int i = 0; i < streak_light_count; ++i) {
            const StreakLight light = streak_light(i);
            if (light.on_axis() || light.azimuth == 0)
                points += fmt::format("v{}\n", streak_elevations[size_t(light.elevation)]);
            points += fmt::format("h{} ", streak_azimuths[size_t(light.azimuth)]);
            points += factor_line([&](int k) { return view.picture(i, k).factor; });
        }
        write_file(folder + point_text(streak_views[v]), points);
    }
    write_file(folder + ambient_text, ambient);
}

std::ifstream open_text(const std::string& path) {
    std::ifstream file(path);
    if (!file) throw input_error(path, "cannot be read");
    return file;
}

/// Ten factors; throws where there are fewer or where one is no finite number of 0 or more.
std::array<float, streak_oscillations> read_factors(std::istringstream& line, const std::string& path, int number) {
    std::array<float, streak_oscillations> factors;
    for (float& f : factors)
        if (!(line >> f) || !std::isfinite(f) || f < 0)
            throw input_error(fmt::format("{}:{}", path, number), "has no ten factors of 0 or more");
    return factors;
}

void read_ambient_factors(const std::string& path, StreakDatabase& database) {
    std::ifstream file = open_text(path);
    std::string text;
    std::array<bool, streak_views.size()> found = {};
    int view = -1;
    for (int number = 1; std::getline(file, text); ++number) {
        std::istringstream line(text);
        std::string word;
        if (!(line >> word)) continue;
        if (word.rfind("cv", 0) == 0) {
            view = std::atoi(word.c_str() + 2);
            continue;
        }
        line = std::istringstream(text);
        const auto factors = read_factors(line, path, number);
        for (size_t v = 0; v < streak_views.size(); ++v) {
            if (streak_views[v] != view) continue;
            found[v] = true;
            for (size_t k = 0; k < factors.size(); ++k) database.views[v].ambient[k].factor = factors[k];
        }
    }
    for (size_t v = 0; v < streak_views.size(); ++v)
        if (!found[v]) throw input_error(path, fmt::format("is truncated (expected factors of cv{})", streak_views[v]));
}

void read_point_factors(const std::string& path, StreakDatabase::View& view) {
    std::ifstream file = open_text(path);
    std::string text;
    std::vector<bool> found(streak_light_count);
    int elevation = 0;
    for (int number = 1; std::getline(file, text); ++number) {
        std::istringstream line(text);
        std::string word;
        if (!(line >> word) || word.rfind("cv", 0) == 0) continue;
        if (word[0] == 'v') {
            elevation = std::atoi(word.c_str() + 1);
            continue;
        }
        if (word[0] != 'h') throw input_error(fmt::format("{}:{}", path, number), "is not a line of factors");
        const int azimuth = std::atoi(word.c_str() + 1);
        for (int i = 0; i < streak_light_count; ++i) {
            const StreakLight light = streak_light(i);
            if (streak_elevations[size_t(light.elevation)] != elevation ||
                streak_azimuths[size_t(light.azimuth)] != azimuth)
                continue;
            const auto factors = read_factors(line, path, number);
            found[size_t(i)] = true;
            for (int k = 0; k < streak_oscillations; ++k)
                view.pictures[size_t(i * streak_oscillations + k)].factor = factors[size_t(k)];
        }
    }
    for (int i = 0; i < streak_light_count; ++i) {
        const StreakLight light = streak_light(i);
        if (!found[size_t(i)])
            throw input_error(
                path, fmt::format("is truncated (expected factors of v{} h{})",
                                  streak_elevations[size_t(light.elevation)], streak_azimuths[size_t(light.azimuth)]));
    }
}

void read_picture(const std::string& path, StreakDatabase::View& view, StreakPicture& picture) {
    Image<uint16_t> image = read_grey16(path);
    if (image.width != view.width || image.height != view.height)
        throw input_error(path, fmt::format("differs in size from the other pictures of its view (got {}x{}, expected "
                                            "{}x{})",
                                            image.width, image.height, view.width, view.height));
    picture.values = std::move(image.pixels);
}

int mirrored_light(int index, bool swap_elevation, bool swap_azimuth) {
    StreakLight light = streak_light(index);
    if (swap_elevation) light.elevation = int(streak_elevations.size()) - 1 - light.elevation;
    if (swap_azimuth && !light.on_axis()) light.azimuth = int(streak_azimuths.size()) - 1 - light.azimuth;
    for (int i = 0; i < streak_light_count; ++i) {
        const StreakLight other = streak_light(i);
        if (other.elevation == light.elevation && other.azimuth == light.azimuth) return i;
    }
    return index;
}

/// Turns lights so that those behind the drop are at 180 degrees, and below it where the camera looks down on it: that
/// is where they shine through the drop into the camera.
void orient(StreakDatabase& database) {
    const auto brightness = [&](int view, auto&& side) {
        double sum = 0;
        for (int i = 0; i < streak_light_count; ++i)
            if (side(streak_light(i).direction()))
                for (int k = 0; k < streak_oscillations; ++k) sum += database.views[size_t(view)].picture(i, k).factor;
        return sum;
    };
    const bool azimuth = brightness(0, [](Vec3 d) { return d.z > 0; }) > brightness(0, [](Vec3 d) { return d.z < 0; });
    const float behind = azimuth ? 1 : -1;
    const bool elevation = brightness(2, [&](Vec3 d) { return d.z * behind > 0 && d.y > 0; }) >
                           brightness(2, [&](Vec3 d) { return d.z * behind > 0 && d.y < 0; });
    if (!azimuth && !elevation) return;
    for (StreakDatabase::View& view : database.views) {
        std::vector<StreakPicture> turned(view.pictures.size());
        for (int i = 0; i < streak_light_count; ++i)
            for (int k = 0; k < streak_oscillations; ++k)
                turned[size_t(mirrored_light(i, elevation, azimuth) * streak_oscillations + k)] =
                    std::move(view.pictures[size_t(i * streak_oscillations + k)]);
        view.pictures = std::move(turned);
    }
}

}  // namespace

void write_streaks(const std::string& folder, const std::vector<StreakDatabase>& widths,
                   const std::function<void(double)>& progress) {
    std::error_code error;
    if (fs::exists(folder, error)) throw usage_error(folder, "exists already (expected a new folder)");
    const std::string work = folder + ".tmp";
    fs::remove_all(work, error);
    const auto make = [&](const std::string& path) {
        fs::create_directories(path, error);
        if (error) throw Error(ExitCode::render_failed, path, fmt::format("cannot be made ({})", error.message()));
    };
    make(work + "/env_light_database/txt");
    make(work + "/point_light_database/txt");
    write_factors(work, widths.front());
    std::atomic<int> done = 0;
    for (const StreakDatabase& database : widths) {
        const int width = database.views[0].width;
        make(work + ambient_folder(width));
        for (const int view : streak_views) make(work + point_folder(width, view));
        const int tasks = int(streak_views.size()) * streak_light_count;
        parallel_for(tasks, [&](int task) {
            const size_t v = size_t(task / streak_light_count);
            const int light = task % streak_light_count;
            const StreakDatabase::View& view = database.views[v];
            for (int k = 0; k < streak_oscillations; ++k) {
                write_picture(
                    work + point_folder(width, streak_views[v]) + point_name(streak_views[v], streak_light(light), k),
                    view.picture(light, k), view.width, view.height);
                if (light == 0)
                    write_picture(work + ambient_folder(width) + ambient_name(streak_views[v], k),
                                  view.ambient[size_t(k)], view.width, view.height);
            }
            progress(double(++done) / double(tasks * int(widths.size())));
        });
    }
    fs::rename(work, folder, error);
    if (error) throw Error(ExitCode::render_failed, folder, fmt::format("cannot be made ({})", error.message()));
}

StreakDatabase read_streaks(const std::string& folder, int width) {
    std::error_code error;
    if (width == 0)
        for (const int choice : {4, 32, 8, 16})
            if (fs::exists(folder + point_folder(choice, 0), error)) width = choice;
    if (width == 0) throw input_error(folder, "is no streak database (expected point_light_database/size16 in it)");
    StreakDatabase database;
    for (StreakDatabase::View& view : database.views)
        view.pictures.resize(size_t(streak_light_count) * streak_oscillations);
    read_ambient_factors(folder + ambient_text, database);
    for (size_t v = 0; v < streak_views.size(); ++v) {
        StreakDatabase::View& view = database.views[v];
        read_point_factors(folder + point_text(streak_views[v]), view);
        const ImageInfo first = read_image_info(folder + ambient_folder(width) + ambient_name(streak_views[v], 0));
        view.width = first.width, view.height = first.height;
    }
    parallel_for(int(streak_views.size()) * streak_light_count, [&](int task) {
        const size_t v = size_t(task / streak_light_count);
        const int light = task % streak_light_count;
        StreakDatabase::View& view = database.views[v];
        for (int k = 0; k < streak_oscillations; ++k) {
            const std::string points = folder + point_folder(width, streak_views[v]);
            read_picture(points + point_name(streak_views[v], streak_light(light), k), view,
                         view.pictures[size_t(light * streak_oscillations + k)]);
            if (light == 0)
                read_picture(folder + ambient_folder(width) + ambient_name(streak_views[v], k), view,
                             view.ambient[size_t(k)]);
        }
    });
    orient(database);
    return database;
}

}  // namespace pluvia
