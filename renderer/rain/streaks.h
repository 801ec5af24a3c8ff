// The drops that one camera can see at a width of some pixels during its exposure, as streaks in camera coordinates.
// Smaller and farther drops are left to the rain medium. Looked up per ray through streak_bins.h.
#pragma once

#include "renderer/core/view.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace pluvia {

struct RainSettings {
    std::vector<double> intensities_mm_per_h;  // of all pictures wanted; <= 0 is no rain
    Vec3d wind;                                // m/s, world
    /// Metres that the air has moved from the sequence's start to mid-exposure, where winds before were others; empty:
    /// wind times that time. With it drops go on from frame to frame while the wind changes.
    std::optional<Vec3d> wind_travel = {};
    uint64_t seed = 0;
    double min_width_pixels = 0.25;  // drops narrower than this belong to the medium; the number of streaks grows as
                                     // its inverse cube
    double fog_extinction = 0;       // 1/m, of a fog that hangs where it rains, at every intensity
    double lowest_ground = 0;        // metres, world y: there are drops from here to rain_height above
    double near = 0.1;               // metres of view depth: drops and medium begin here
    // As "Learning from Rendering" draws streaks, and not as they are:
    double painted_distance = 0;  // metres: farther drops are as wide as if they were this far and painted_width at
                                  // least, up to painted_reach times as far, and there are none beyond; 0 = true width
    double share = 1;             // of the drops, whatever their size
};
/// Both as seen in HRI: its quads are at least so many pixels wide (the published code's smallest box), and with drops
/// of its density its pictures have as many streaks as there are drops in 9 m.
constexpr double painted_width = 3, painted_reach = 5;

/// A falling drop relative to the camera during one exposure. View axes: x right, y up, z view depth. Single precision
/// is enough: relative to the camera it rounds directions by 1e-7, a few 1e-4 pixels, and that the same for all rays.
/// Where the camera turns, the path is that of a drop at mid-exposure going straight on: with a turn of a radians and a
/// drop that moves m metres during the exposure at d metres it is off by at most f (a^2 / 8 + a m / (4 d)) pixels near
/// the axis: for a car in a bend (0.5 rad/s, 1/60 s, f = 1000 pixels) 0.01 pixels, and 0.3 more for drops at 1 m.
struct Streak {
    Vec3 start;                // centre of the drop when the shutter opens
    Vec3 velocity;             // relative to the camera, m/s
    float radius;              // metres, as painted
    float threshold_mm_per_h;  // the streak is seen at every intensity >= this
    uint64_t key;              // of the drop: the same in all frames
};

/// A drop counts from this view depth on: nearer than two diameters it would be touching the lens. Matters only where
/// the camera moves so fast that it meets drops.
inline float contact_depth(const Streak& streak) {
    return 4 * streak.radius;
}

/// Smallest view depth of the drop's centre while it counts.
inline float nearest_depth(const Streak& streak, float exposure_time) {
    const float end = streak.start.z + streak.velocity.z * exposure_time;
    return std::max(std::min(streak.start.z, end), contact_depth(streak));
}

/// All drops that exist at the largest intensity asked for and may be in the picture during the exposure, ordered by
/// nearest_depth, then key. view.position is the camera's place at mid-exposure, as for the background.
/// Drop or medium is decided by the view depth z of the drop's centre at mid-exposure alone: it is a streak if
/// z >= near and (painted) diameter * focal_pixels >= min_width_pixels * z. Which streaks are off the picture is
/// decided conservatively. A streak does not depend on what other intensities are asked for. Throws a usage error for
/// settings out of range.
std::vector<Streak> find_streaks(const View& view, const RainSettings& settings);

}  // namespace pluvia
