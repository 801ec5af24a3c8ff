// Streaks of the database on drops of any size and any camera: how much brighter or darker than its mean a drop is
// somewhere on its streak, by the direction that its light comes from.
#pragma once

#include "shaders/streak_database.h"

namespace pluvia {

/// Where on a streak, and seen from where.
struct StreakPlace {
    int view = 0, oscillation = 0;  // indices
    float across = 0;               // -1 (left) to 1, seen with the fall downwards
    float along = 0;                // 0 (top) to 1
    Vec3 toward, right;             // level directions from the drop: to the camera, and to the right in its picture
    float up = 1;                   // -1 where the camera looks up at the drop: the database is then upside down
};

/// direction: of the camera's ray in the scene (y up), unit; key: of the drop; across: as above.
/// time: fraction of the exposure; exposure: seconds; diameter: metres. A streak shows as much of a picture as the drop
/// has time to oscillate in, and at most all of it.
StreakPlace streak_place(Vec3 direction, uint64_t key, double diameter, double exposure, float across, float time);

class StreakTextures {
public:
    explicit StreakTextures(StreakDatabase database);

    /// Mean 1 over each streak, weighted with the time that the drop covers a place. 1 where the database holds no
    /// light from there. wi: direction to the light, scene, unit.
    float brightness(const StreakPlace& place, Vec3 wi) const;

private:
    struct View {
        float left = 0, width = 0;         // of the columns that show the drop, pixels; of all pictures of the view
        float top = 0, bottom = 0;         // rows between which its whole disk has passed
        std::vector<float> inverse_chord;  // per column: 1 over the share of the exposure that it is covered
        std::vector<float> scale;          // per picture: value to brightness; 0: nothing to see
    };
    StreakDatabase database_;
    std::array<View, streak_views.size()> views_;
};

}  // namespace pluvia
