// Japanese shopping streets by a plan: rows of tenements under signs, paving, poles with cables, lanterns and things.
// The plans are in japanesestreet.cpp.
#pragma once

#include "renderer/scene/scene.h"

#include <string>
#include <vector>

namespace pluvia {

struct ArcadePlan {
    std::string name;
    float wall = 3.9f, kerb = 3.0f;      // x of the walls and of the kerbs
    float near_end = 24, far_end = -52;  // z of the rows' ends
    // Letters of arcade.cpp from the left as one faces the row.
    std::string left, right, far = "CAFECAC", behind = "AFCEAFC";
    int extra_storeys = 0;
    float signs = 2;    // that stand out from a house one above the other, about
    bool poles = true;  // with cables
    double lantern_pitch = 8.5;
    std::vector<Camera> cameras = {};
};

Scene build_arcade(const ArcadePlan& plan);

}  // namespace pluvia
