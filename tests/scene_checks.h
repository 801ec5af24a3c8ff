// What every street that builders make must fulfil, as checks of doctest.
#pragma once

#include "renderer/scene/scene.h"

#include <string>
#include <vector>

namespace pluvia {

size_t placed_triangles(const Scene& scene);

/// Every picture is whole and used by a material, every material by a mesh.
void check_pictures(const Scene& scene);
/// All attributes are there and in range, normals of unit length.
void check_vertices(const Scene& scene);
/// Every triangle has an area, faces as its normals do, and spans its picture.
void check_triangles(const Scene& scene);
/// Exactly these cameras, with lenses of 30 to 50 mm, that walk.
void check_cameras(const Scene& scene, const std::vector<std::string>& names);
/// Every object has a class of Cityscapes, all its parts the same; each of `expected` occurs.
void check_classes(const Scene& scene, const std::vector<std::string>& expected);
/// At least so many objects are lamps, and nothing is brighter than `brightest`, cd/m2.
void check_lamps(const Scene& scene, size_t least, float brightest);
/// Two builds give the same file, smaller than most_bytes, that holds the scene.
void check_file(const Scene& scene, const Scene& again, double most_bytes);

}  // namespace pluvia
