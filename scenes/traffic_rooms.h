// Where there is room to move in each street: for traffic.cpp.
#pragma once

#include "scenes/route.h"

#include <optional>
#include <string>
#include <vector>

namespace pluvia {

/// A route and how many go along it, evenly spread.
struct Track {
    std::vector<Vec3d> corners;
    Route::Settings route;
    int count = 0;
};

struct Room {
    std::optional<Track> cars;  // one place among them is the camera's
    bool small_cars = false;    // of 1.5 m instead of 1.8 m
    Track camera;               // where there are no cars; count is 0
    std::vector<Track> walks;
};

/// Throws Error (usage) for a street that is not known.
Room traffic_room(const std::string& street);

}  // namespace pluvia
