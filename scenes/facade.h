// Town houses: a facade of bays over a ground floor of shops or doors, with its cornice, and the body behind it.
#pragma once

#include "scenes/palette.h"
#include "scenes/window.h"

#include <string>
#include <vector>

namespace pluvia {

/// One house of a row, in the facade frame of wall.h. One letter a bay, from left to right:
/// ground: w window, d door above steps, S display window, E shop entrance, a arched and glazed door, A arched window,
///         b wall. Neighbouring S, E, a and A share a room behind them.
/// upper:  w window, p pair of narrow windows, b wall; the same on all storeys
struct TownHouse {
    std::string name = {};  // equal houses with different names differ in windows, wares and stones
    float width = 8;
    std::string ground = "SES", upper = "www";
    float ground_height = 4.3f;
    std::vector<float> storeys = {3.6f, 3.4f, 3.2f};
    std::string wall = "red_brick", base = "limestone", trim = "limestone", cornice = "limestone";  // finishes
    WindowStyle window = {};
    float arch = 0;      // rise of the upper windows' heads
    bool hoods = false;  // cornices over the windows instead of a row of stones
    bool quoins = false;
    bool fire_escape = false;
    std::string sign = {};  // letters over the shop
    std::string shop_paint = "green_paint";
    bool awning = false;
    Rgb awning_color = {0.5f, 0.06f, 0.05f};
    bool cafe = false;
    float lit = 0.25f;  // share of windows with light
    float depth = 12;   // of the body behind the facade
};
Assembly town_house(Palette& palette, const TownHouse& house);

/// Steps up to a door between two iron railings, in the facade frame; centre at x.
void add_stoop(Assembly& assembly, Palette& palette, float x, float width, float height, int steps);

/// Iron balconies with ladders before the windows at these heights.
void add_fire_escape(Assembly& assembly, Palette& palette, float left, float right, const std::vector<float>& floors);

}  // namespace pluvia
