// The street scenes by name. Each is built from nothing but numbers, the same bytes every time.
#pragma once

#include "renderer/scene/scene.h"

#include <functional>
#include <string>
#include <vector>

namespace pluvia {

struct Builder {
    std::string name;         // of the scene and its file
    std::string description;  // one line
    std::function<Scene()> build;
};

/// All scenes in the order in which they are listed to users.
const std::vector<Builder>& builders();

/// A narrow Japanese alley of timber houses, 3 m wide and 25 m long. Cameras: front, mid, side, low.
Scene build_lane();

/// A street of four-storey houses with shops, 18 m between walls and 112 m long.
/// Cameras: front, far, back, sideleft, sideright, sideinner.
Scene build_citystreet();

/// A shopping street of tiled houses under signs, 7.8 m between walls and 76 m long. Cameras: camera1 to camera10.
Scene build_japanesestreet();

// Five more by other plans. Cameras: front, back, sideleft, sideright.
Scene build_avenue();
Scene build_terrace();
Scene build_brickyard();
Scene build_backstreet();
Scene build_stationstreet();

}  // namespace pluvia
