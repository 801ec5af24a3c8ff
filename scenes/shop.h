// Shops: fronts of glass with what is sold behind them, doors, fascias with letters, awnings. Facade frame as in
// wall.h.
#pragma once

#include "scenes/palette.h"
#include "scenes/wall.h"

namespace pluvia {

/// A room behind a front, open towards it: walls, ceiling with lights, shelves with goods and a counter.
struct ShopRoom {
    float left = 0, right = 5, floor = 0.1f, ceiling = 3.2f, front = -0.3f, depth = 4;
    std::string walls = "pale_stucco";  // finish
    Rgb light = {1, 0.64f, 0.36f};      // hue of its lights
    float luminance = 1400;             // of its ceiling panels, cd/m2: some 300 lx on the counter
    bool cafe = false;                  // tables and chairs instead of shelves
};
void add_shop_room(Assembly& assembly, Palette& palette, const ShopRoom& room, Chance& chance);

/// Display window in an opening: frame, transom light, one large pane, goods on a plinth behind it.
void add_shop_window(Assembly& assembly, Palette& palette, const Opening& opening, const std::string& frame,
                     Chance& chance);

/// Glazed door with a kick plate, a handle and a light above it; z: its face.
void add_shop_door(Assembly& assembly, Palette& palette, const Opening& opening, float z, const std::string& frame,
                   const std::string& pane, Chance& chance);

/// Band from y0 to y1 with raised letters, and lamps on swan necks that light it.
struct Fascia {
    float left = 0, right = 5, bottom = 3.2f, top = 3.9f;
    std::string text, board = "green_paint", letters = "brass";  // finishes
    bool lamps = true;
};
void add_fascia(Assembly& assembly, Palette& palette, const Fascia& fascia);

/// Striped canvas on a folding frame, its upper edge at y on the wall, with a valance.
struct Awning {
    float left = 0, right = 3, y = 3.1f, reach = 1.2f, fall = 0.75f;
    Rgb stripe_a = {0.55f, 0.06f, 0.05f}, stripe_b = {0.8f, 0.76f, 0.68f};
};
void add_awning(Assembly& assembly, Palette& palette, const Awning& awning);

}  // namespace pluvia
