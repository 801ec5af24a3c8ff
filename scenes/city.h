// City streets by a plan: rows of houses along a road with pavements, trees, lamps, parked cars and what else stands
// there. The street runs from z = 40 to z = -72; a row of houses across it ends the view at both ends, beyond a
// crossing street. The plans are in citystreet.cpp, the kinds of houses in city_houses.h.
#pragma once

#include "scenes/car.h"
#include "scenes/road.h"

#include <string>
#include <vector>

namespace pluvia {

struct ParkedCar {
    std::string paint;  // finish
    CarShape shape;
    bool left;
    double z;
};

struct CityPlan {
    std::string name;
    Road road = {.half_width = 4.4f, .near = 40, .far = -72, .seed = 3};
    // Letters of city_houses.h from the left as one faces the row; small ones are the second house of a kind.
    std::string left, right, far = "HEADFGC", behind = "AFdCEH";
    int extra_storeys = 0;
    int trees = 8;             // on each side
    double lamp_pitch = 25.6;  // metres from lamp to lamp on each side
    std::vector<ParkedCar> cars = {};
    std::vector<Camera> cameras = {};
};

Scene build_city(const CityPlan& plan);

}  // namespace pluvia
