// A database of rain streaks by the design of Garg and Nayar 2006, "Photorealistic Rendering of Rain Streaks": what a
// camera records of one oscillating drop of 1.6 mm in 1/60 s, for views, directions of a single light and random
// oscillations. Made by streak_tracing.h, kept in files by streak_files.h, used for the paper's composition.
//
// Directions are seen from the drop, whose fall is down. The camera stands at elevation `view` and azimuth 0; a light
// stands at an elevation and an azimuth from 0 (above the camera) to 180 degrees (behind the drop). Light from the
// other side gives the mirrored picture.
#pragma once

#include "renderer/core/vec.h"

#include <array>
#include <cstdint>
#include <vector>

namespace pluvia {

constexpr std::array<int, 5> streak_views = {0, 20, 40, 60, 80};                                  // degrees
constexpr std::array<int, 10> streak_elevations = {-90, -70, -50, -30, -10, 10, 30, 50, 70, 90};  // degrees
constexpr std::array<int, 9> streak_azimuths = {10, 30, 50, 70, 90, 110, 130, 150, 170};          // degrees
constexpr int streak_oscillations = 10;
constexpr double streak_diameter = 1.6e-3;    // metres
constexpr double streak_exposure = 1.0 / 60;  // seconds

/// Straight above and below all azimuths are one light, filed under the last of them.
constexpr int streak_light_count = 2 + int(streak_azimuths.size() * (streak_elevations.size() - 2));

struct StreakLight {
    int elevation, azimuth;  // indices; azimuth is the last where the elevation is +-90

    bool on_axis() const { return elevation == 0 || elevation == int(streak_elevations.size()) - 1; }
    Vec3 direction() const;
};
/// index: 0 to streak_light_count - 1, rising with elevation, then azimuth.
StreakLight streak_light(int index);
/// The light nearest to a unit direction by elevation, then azimuth. mirrored: it stands on the other side.
int nearest_streak_light(Vec3 direction, bool* mirrored = nullptr);
/// Index of the nearest view; elevation: radians.
int nearest_streak_view(float elevation);

/// One picture: the drop falls down through it. Value times the illuminance of the light, on a plane that faces it, is
/// the drop's radiance times the share of its stay during which it covers the place; as 16 bits and a factor.
struct StreakPicture {
    std::vector<uint16_t> values;  // row-major; empty = not there
    float factor = 0;              // of value / 65535

    friend bool operator==(const StreakPicture&, const StreakPicture&) = default;
};
/// Picture whose largest value is 65535; all 0 where nothing is above 0.
StreakPicture picture_from(const std::vector<float>& values);

struct StreakDatabase {
    struct View {
        int width = 0, height = 0;                               // pixels, of all pictures of the view
        std::vector<StreakPicture> pictures;                     // [streak_light_count][streak_oscillations]
        std::array<StreakPicture, streak_oscillations> ambient;  // under an even sky above a black ground

        const StreakPicture& picture(int light, int oscillation) const {
            return pictures[size_t(light * streak_oscillations + oscillation)];
        }
        friend bool operator==(const View&, const View&) = default;
    };
    std::array<View, streak_views.size()> views;

    friend bool operator==(const StreakDatabase&, const StreakDatabase&) = default;
};

/// The same streaks at 1/n of the width, with the same factors: pixels averaged in blocks.
StreakDatabase narrowed(const StreakDatabase& database, int n);

}  // namespace pluvia
