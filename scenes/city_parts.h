// Steps of build_city, for city.cpp.
#pragma once

#include "scenes/city.h"

namespace pluvia {

std::vector<TreePit> tree_pits(const CityPlan& plan);
void add_trees(const CityPlan& plan, Street& street, Palette& palette);
void add_furniture(const CityPlan& plan, Street& street, Palette& palette);
void add_cars(const CityPlan& plan, Street& street, Palette& palette);

}  // namespace pluvia
