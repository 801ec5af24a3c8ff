#include "tools/frame_objects.h"

#include "renderer/scene/taxonomy.h"

#include <algorithm>

namespace pluvia {
namespace {

using Json = nlohmann::ordered_json;

Json numbers(Vec3d v) {
    return {v.x, v.y, v.z};
}

/// Rows of the matrix, for points in the file's coordinates.
Json matrix(const Transform& in_scene, Vec3d origin) {
    const Transform t = translate(origin) * in_scene * translate(origin * -1.0);
    Json rows = Json::array();
    for (int r = 0; r < 3; ++r)
        for (const Vec3d& column : {t.column_x, t.column_y, t.column_z, t.translation}) rows.push_back(column[r]);
    return rows;
}

void add_motion(Json& j, const char* key, const ObjectMotion& motion, Vec3d origin) {
    if (!motion.moves || motion.bends) return;
    for (const Transform& part : motion.parts) j[key].push_back(matrix(part, origin));
}

void add_extent(Json& j, const ObjectExtent& extent, int64_t visible, const View& view, Vec3d origin) {
    const PixelBox& p = extent.projected;
    const double inside = intersection(p, {0, 0, double(view.width), double(view.height)}).area();
    j["amodal_box"] = {p.left, p.top, p.right, p.bottom};
    j["amodal_pixels"] = extent.pixels;
    // The ray that sees and the test that counts round differently at edges.
    j["visible_fraction"] = extent.pixels > 0 ? std::min(1.0, double(visible) / double(extent.pixels)) : 1.0;
    j["truncated"] = p.area() > 0 ? 1 - inside / p.area() : 0.0;
    const OrientedBox& box = extent.box;
    j["box_3d"] = {{"center", numbers(box.centre + origin)},
                   {"size", numbers(box.size)},
                   {"axes", {numbers(box.axes[0]), numbers(box.axes[1]), numbers(box.axes[2])}}};
}

}  // namespace

void SeenObjects::look(const std::vector<uint32_t>& ids, int first_row, int width) {
    for (size_t i = 0; i < ids.size();) {
        // Neighbours mostly show the same.
        const size_t row_end = (i / size_t(width) + 1) * size_t(width);
        size_t end = i + 1;
        while (end < row_end && ids[end] == ids[i]) ++end;
        if (ids[i] != 0) {
            SeenObject& object = seen_[ids[i]];
            const int x = int(i % size_t(width)), y = first_row + int(i / size_t(width));
            object.pixels += int64_t(end - i);
            object.left = std::min(object.left, x), object.right = std::max(object.right, x + int(end - i));
            object.top = std::min(object.top, y), object.bottom = std::max(object.bottom, y + 1);
        }
        i = end;
    }
}

const SeenObject* SeenObjects::find(uint32_t id) const {
    const auto found = seen_.find(id);
    return found == seen_.end() ? nullptr : &found->second;
}

Json objects_json(const SceneObjects& objects, const SeenObjects& seen, const std::vector<ObjectExtent>& extents,
                  const ObjectMotions& motions, const View& view, Vec3d origin) {
    const bool any = !motions.next.empty() || !motions.previous.empty();
    const auto motion = [](const std::vector<ObjectMotion>& list, size_t i) {
        return list.empty() ? ObjectMotion() : list[i];
    };
    Json list = Json::array();
    for (size_t i = 0; i < objects.objects.size(); ++i) {
        const LabelObject& object = objects.objects[i];
        const SeenObject* visible = seen.find(object.id);
        if (!visible && (extents.empty() || extents[i].pixels == 0)) continue;
        Json j;
        j["name"] = object.name, j["id"] = object.id;
        j["class"] = taxonomy()[size_t(object.class_id)].name, j["class_id"] = object.class_id;
        if (!object.unknown_class.empty()) j["unknown_class"] = object.unknown_class;
        j["number"] = object.number, j["index"] = i;
        if (any) {
            const ObjectMotion next = motion(motions.next, i), previous = motion(motions.previous, i);
            j["moves"] = next.moves || previous.moves;
            add_motion(j, "motion_next", next, origin), add_motion(j, "motion_previous", previous, origin);
        }
        j["visible_pixels"] = visible ? visible->pixels : 0;
        if (visible) j["box"] = {visible->left, visible->top, visible->right, visible->bottom};
        if (!extents.empty()) add_extent(j, extents[i], visible ? visible->pixels : 0, view, origin);
        list.push_back(std::move(j));
    }
    return list;
}

namespace {

bool same_shape(const Scene& now, const Scene& then, size_t i) {
    return now.meshes[size_t(now.instances[i].mesh)].positions == then.meshes[size_t(then.instances[i].mesh)].positions;
}

bool stays(const Scene& now, const Scene& then, size_t i) {
    return now.instances[i].scene_from_object == then.instances[i].scene_from_object && same_shape(now, then, i);
}

}  // namespace

bool same_places(const Scene& a, const Scene& b) {
    if (a.instances.size() != b.instances.size()) return false;
    for (size_t i = 0; i < a.instances.size(); ++i)
        if (!stays(a, b, i)) return false;
    return true;
}

std::vector<ObjectMotion> object_motions(const SceneObjects& objects, const Scene& now, const Scene& then) {
    std::vector<ObjectMotion> motions(objects.objects.size());
    for (size_t i = 0; i < now.instances.size(); ++i) {
        ObjectMotion& motion = motions[size_t(objects.object_of_instance[i])];
        const Transform &from = now.instances[i].scene_from_object, &to = then.instances[i].scene_from_object;
        motion.moves = motion.moves || !stays(now, then, i);
        motion.bends = motion.bends || !same_shape(now, then, i) || from.determinant() == 0;
        if (motion.bends) continue;
        const Transform part = from == to ? Transform() : to * inverse(from);
        if (std::find(motion.parts.begin(), motion.parts.end(), part) == motion.parts.end())
            motion.parts.push_back(part);
    }
    return motions;
}

}  // namespace pluvia
