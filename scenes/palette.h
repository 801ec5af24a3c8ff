// Palette: finishes by name, made when they are first asked for, so that a scene holds only the materials and pictures
// that it shows. The plain ones are a table in palette.cpp; parts with pictures of their own (windows, signs) add
// theirs.
#pragma once

#include "scenes/assembly.h"

#include <functional>
#include <map>
#include <string>

namespace pluvia {

class Palette {
public:
    explicit Palette(Street& street) : street_(street) {}

    /// Index of the finish of that name. Throws Error (input) for a name that palette.cpp does not have.
    int operator()(const std::string& name);

    /// The same for a finish that its user describes; `make` is called once per name.
    int operator()(const std::string& name, const std::function<Material(Scene&)>& make);

    Street& street() { return street_; }

private:
    const MapTextures& pictures(const std::string& name);

    Street& street_;
    std::map<std::string, int> finishes_;
    std::map<std::string, MapTextures> pictures_;
};

}  // namespace pluvia
