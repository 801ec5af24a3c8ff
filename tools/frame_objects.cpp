#include "tools/frame_objects.h"

#include "renderer/scene/taxonomy.h"

#include <algorithm>

namespace pluvia {
namespace {

using Json = nlohmann::ordered_json;

Json numbers(Vec3d v) {
    return {v.x, v.y, v.z};
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
                  const std::vector<bool>& moving, const View& view, Vec3d origin) {
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
        if (!moving.empty()) j["moves"] = bool(moving[i]);
        j["visible_pixels"] = visible ? visible->pixels : 0;
        if (visible) j["box"] = {visible->left, visible->top, visible->right, visible->bottom};
        if (!extents.empty()) add_extent(j, extents[i], visible ? visible->pixels : 0, view, origin);
        list.push_back(std::move(j));
    }
    return list;
}

namespace {

bool stays(const Scene& now, const Scene& then, size_t i) {
    const Instance &a = now.instances[i], &b = then.instances[i];
    return a.scene_from_object == b.scene_from_object &&
           now.meshes[size_t(a.mesh)].positions == then.meshes[size_t(b.mesh)].positions;
}

}  // namespace

bool same_places(const Scene& a, const Scene& b) {
    if (a.instances.size() != b.instances.size()) return false;
    for (size_t i = 0; i < a.instances.size(); ++i)
        if (!stays(a, b, i)) return false;
    return true;
}

std::vector<bool> moving_objects(const SceneObjects& objects, const Scene& now, const Scene& then) {
    std::vector<bool> moving(objects.objects.size());
    for (size_t i = 0; i < now.instances.size(); ++i)
        if (!stays(now, then, i)) moving[size_t(objects.object_of_instance[i])] = true;
    return moving;
}

}  // namespace pluvia
