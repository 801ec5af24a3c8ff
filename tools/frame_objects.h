// The objects of a frame: which of them are seen, and their boxes, for frame.json.
#pragma once

#include "renderer/scene/object_extent.h"
#include "renderer/transport/layers.h"

#include <nlohmann/json.hpp>

#include <unordered_map>

namespace pluvia {

struct SeenObject {
    int64_t pixels = 0;
    int left = 1 << 30, top = 1 << 30, right = 0, bottom = 0;  // right and bottom are beyond the last pixel
};

/// Where ids are in a picture, gathered from rows on their way.
class SeenObjects {
public:
    void look(const std::vector<uint32_t>& ids, int first_row, int width);
    const SeenObject* find(uint32_t id) const;

private:
    std::unordered_map<uint32_t, SeenObject> seen_;
};

/// How an object gets from one frame to another.
struct ObjectMotion {
    bool moves = false;
    bool bends = false;              // its shape changes: no rigid motion says where its points go
    std::vector<Transform> parts{};  // of the scene's coordinates; of each motion that its instances have, one
};
struct ObjectMotions {
    std::vector<ObjectMotion> next, previous;
};

/// One entry per object that the picture shows or, with extents, would show if nothing stood before it.
/// extents: of all objects, or empty for entries without boxes of what is hidden. Keys: name, id, class, class_id,
/// number, index (from 0, among all objects of the scene, so the same in every frame), moves, motion_next and
/// motion_previous (of an object that moves and does not bend: for each of its parts that moves otherwise than the
/// others 12 numbers, the rows of the matrix that takes points of this frame to the other), visible_pixels, box (left,
/// top, right, bottom in pixels; the last two beyond it); with extents amodal_box (beyond the picture's edges
/// too), amodal_pixels (in the picture), visible_fraction (of these), truncated (share of the amodal box beyond the
/// edges), and box_3d: center in the file's coordinates, size in metres along axes, three unit vectors of which the
/// last is the object's front. Motions: per object; empty where nothing moves or nobody asks.
nlohmann::ordered_json objects_json(const SceneObjects& objects, const SeenObjects& seen,
                                    const std::vector<ObjectExtent>& extents, const ObjectMotions& motions,
                                    const View& view, Vec3d origin);

/// Whether every instance is where it is in the other scene and has the same shape.
bool same_places(const Scene& a, const Scene& b);

/// How the objects of a scene get to a scene of another time, per object.
std::vector<ObjectMotion> object_motions(const SceneObjects& objects, const Scene& now, const Scene& then);

}  // namespace pluvia
