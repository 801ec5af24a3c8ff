// The parts of the lane, for its builder lane.cpp and for each other. Finishes are in lane_finishes.cpp, houses in
// lane_house.cpp and lane_roof.cpp, the rest in the file of its noun.
// Facade frame: x to the right along the wall, y up from the ground, z out of the wall into the lane, metres.
#pragma once

#include "scenes/assembly.h"
#include "scenes/wall.h"

#include <string>
#include <vector>

namespace pluvia::lane {

/// Indices of the lane's finishes in Street::finishes.
struct Finishes {
    int red_wood, brown_wood, dark_wood, grey_wood, bamboo;
    int ochre_plaster, white_plaster;
    int granite, concrete, soil, clay, tiled_roof;
    int copper, zinc, iron, painted_metal, rubber, glass, terracotta, porcelain;
    int indigo_cloth, red_cloth;
    int leaf, dark_leaf, frond;
    int lit_window, warm_window, lamp_glass, white_lantern, red_lantern, lit_sign, lit_sign_tall, lit_sign_box;
    int signboard, nameplate, poster, noren_print;
};
Finishes add_finishes(Street& street);

/// A two-storey house of a row, seen by its front. One letter a bay, from left to right:
/// ground: b boards with plaster above, B boards to the beam, l lattice with lit paper behind, k dark lattice,
///         d sliding door with lit paper, D the same behind a noren, s plaster over weatherboards, g corrugated iron
/// upper:  p plaster, m slit window, w lit lattice window, v dark window, b boards, s bamboo blind
struct House {
    std::string name;
    Transform scene_from_facade;
    float width = 6;
    std::string ground, upper;
    int boards, posts, walls;           // finishes
    float ground_height = 2.75f;        // to the beam between the storeys
    float eave_height = 4.9f;           // of the upper wall's top
    float lower_roof_depth = 0.75f;     // 0 = none
    float body_depth = 5;               // into the block
    std::vector<float> downpipes = {};  // x of pipes from the lower gutter to the ground
};
void add_house(Street& street, const Finishes& finishes, const House& house);

/// A wall of boards with a coping of tiles, `height` to the underside of its little roof.
void add_garden_wall(Street& street, const Finishes& finishes, const std::string& name, float width, float height,
                     const Transform& scene_from_facade);

/// Tiled roof that falls from the wall line (z = 0) at `wall_height` out to z = depth, with rafters, boards, eave tiles
/// and gutter; in the facade frame.
struct Eave {
    float width, wall_height, depth;
    float pitch = 0.42f;  // fall per metre
    float back = 0;       // metres that the roof continues behind the wall line, without real tiles
};
void add_eave(Assembly& assembly, const Finishes& finishes, const Eave& eave, Chance& chance);
/// Pipe from the gutter of an eave, back to the wall and down to the ground at x.
void add_downpipe(Assembly& assembly, const Finishes& finishes, const Eave& eave, float x);

/// Paving of a stretch between x = -half_width and half_width from z = near to z = far (far < near) in its own frame,
/// with drains at both sides.
struct Paving {
    std::string name;
    float half_width, near, far;
    Transform scene_from_paving;
};
void add_paving(Street& street, const Finishes& finishes, const Paving& paving);

// Things in their own frames: y up, front towards +z. Standing things have their origin on the ground, hanging and
// mounted ones where they are fixed.
Assembly globe_lamp(const Finishes& finishes);               // on a bracket
Assembly wall_lantern(const Finishes& finishes);             // iron, on an arm of 1 m
Assembly paper_lantern(const Finishes& finishes, bool red);  // hangs by its cord
Assembly floor_lantern(const Finishes& finishes);
Assembly standing_sign(const Finishes& finishes, bool tall);
Assembly box_sign(const Finishes& finishes);       // lit, projects from the wall
Assembly hanging_board(const Finishes& finishes);  // large wooden signboard under a little roof, projects
Assembly noren(const Finishes& finishes, float width, float height);  // hangs from its rod
Assembly bush(const Finishes& finishes, uint64_t seed, float height, int leaves, bool dark);
Assembly palm(const Finishes& finishes, uint64_t seed, float height);
Assembly tree(const Finishes& finishes, uint64_t seed, float height);
Assembly pot(const Finishes& finishes, int finish, float radius, float height);
Assembly bamboo_fence(const Finishes& finishes, float width);  // curved guard at the foot of a wall
Assembly bench(const Finishes& finishes);
Assembly bucket(const Finishes& finishes);
Assembly umbrella_stand(const Finishes& finishes);
Assembly crates(const Finishes& finishes);

/// Places all that hangs and stands in the lane.
void add_furniture(Street& street, const Finishes& finishes);

}  // namespace pluvia::lane
