// Bays: the openings in the frame of a house's front, in the facade frame of lane.h. Filled in lane_bays.cpp.
#pragma once

#include "scenes/lane.h"

namespace pluvia::lane {

constexpr float recess = -0.14f;        // z of the closed body behind the frame
constexpr float post_front = 0.02f;     // z of posts and rails
constexpr float lintel_height = 2.02f;  // of doors and windows on the ground floor

/// One opening of the frame, between two posts and two beams; metres.
struct Bay {
    float left, right, bottom, top;
    float width() const { return right - left; }
};

/// What the bays of one house are made with, and what they are added to.
struct BayWork {
    Assembly& assembly;
    const Finishes& finishes;
    int boards, posts, walls;  // finishes of the house
    Chance& chance;
};

/// Fills one bay as its letter in House::ground or House::upper says.
void fill_ground_bay(const BayWork& work, char letter, const Bay& bay);
void fill_upper_bay(const BayWork& work, char letter, const Bay& bay);

}  // namespace pluvia::lane
