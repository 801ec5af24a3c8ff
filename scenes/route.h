// Routes: closed ways on the ground that cars, people and cameras go round and round, one behind the other.
#pragma once

#include "renderer/core/vec.h"

#include <vector>

namespace pluvia {

struct RoutePlace {
    Vec3d position;
    double heading = 0;  // radians about +y, 0 towards +z; not reduced to one turn
};

/// A polygon with rounded corners. All that goes along it does so by the same law of speed, so that two who set out at
/// different times never meet, and who brakes before a corner is not run into.
class Route {
public:
    struct Settings {
        double radius = 4;        // metres, of the corners; less where edges are too short for it
        double speed = 5;         // m/s on straight ways
        double acceleration = 2;  // m/s2, along the way and towards the middle of a corner
    };
    /// corners: at least three, metres, in their order; heights change evenly along the edges.
    Route(const std::vector<Vec3d>& corners, const Settings& settings);

    double length() const { return places_.back().way; }
    /// Seconds for one round.
    double period() const { return places_.back().time; }
    /// Where one is at a time, which may have any value: period() later one is there again, a turn further.
    RoutePlace at(double seconds) const;

private:
    struct Place {
        double way, time;  // metres and seconds from the start
        Vec3d position;
        double heading, radius, speed;
    };
    void add(Vec3d position, double heading, double radius);
    void add_corner(Vec3d before, Vec3d corner, Vec3d after, double wanted_radius, double& heading);
    void set_times(const Settings& settings);

    std::vector<Place> places_;  // close to each other; the last is the first again
};

}  // namespace pluvia
