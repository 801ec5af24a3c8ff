#include "tools/labels/coco.h"

#include "renderer/core/error.h"
#include "renderer/image/image_io.h"
#include "tools/frame_file.h"
#include "tools/frame_objects.h"
#include "tools/labels/label_export.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>

namespace pluvia {
namespace {

using Json = nlohmann::ordered_json;

/// x, y, width, height.
Json box_json(const SeenObject& seen) {
    return {seen.left, seen.top, seen.right - seen.left, seen.bottom - seen.top};
}

/// Categories that classes map to, once each.
Json categories(bool only_things) {
    std::map<int, Json> list;
    for (const LabelClass& c : taxonomy()) {
        if (c.coco_id == 0 || (only_things && !c.coco_thing)) continue;
        list[c.coco_id] = {{"id", c.coco_id}, {"name", c.coco_name}};
        if (!only_things) list[c.coco_id]["isthing"] = c.coco_thing ? 1 : 0, list[c.coco_id]["color"] = c.color;
    }
    Json result = Json::array();
    for (const auto& [id, category] : list) result.push_back(category);
    return result;
}

/// Id of a panoptic segment, below 2^24 and the same in all frames: a thing's own, or that of the category for the
/// rest.
uint32_t segment_id(const LabelFrame& frame, const LabelClass& label, const FrameObject* object) {
    if (label.coco_id == 0) return 0;
    if (!label.coco_thing || !object) return uint32_t(label.coco_id);
    if (object->number >= 65535)
        throw input_error(frame.path, fmt::format("has too many objects of class {} for COCO (got number {})",
                                                  label.name, object->number));
    return uint32_t(label.id) << 16 | uint32_t(object->number + 1);
}

class Export {
public:
    explicit Export(std::string folder) : folder_(std::move(folder)) {
        std::filesystem::create_directories(folder_ + "/panoptic");
    }

    void add(LabelFrame& frame) {
        const Json image = {
            {"id", ++image_id_}, {"file_name", frame.name + ".png"}, {"width", frame.width}, {"height", frame.height}};
        images_.push_back(image);
        const std::vector<uint32_t> instance = frame.ids("instance.ID"), semantic = frame.ids("semantic.ID");
        add_instances(frame, instance);
        add_panoptic(frame, instance, semantic);
    }

    void finish() {
        const auto write = [&](const char* file, bool only_things, const Json& annotations) {
            const Json all = {{"info", {{"description", "labels by Pluvia"}}},
                              {"images", images_},
                              {"annotations", annotations},
                              {"categories", categories(only_things)}};
            write_text(folder_ + "/" + file, json_text(all) + "\n");
        };
        write("instances.json", true, instances_);
        write("panoptic.json", false, panoptic_);
    }

private:
    void add_instances(const LabelFrame& frame, const std::vector<uint32_t>& ids) {
        SeenObjects seen;
        seen.look(ids, 0, frame.width);
        for (const FrameObject& object : frame.objects) {
            const SeenObject* visible = seen.find(object.id);
            if (!visible || !object.label().coco_thing) continue;
            instances_.push_back(
                {{"id", ++annotation_id_},
                 {"image_id", image_id_},
                 {"category_id", object.label().coco_id},
                 {"segmentation",
                  {{"counts", run_lengths(ids, frame.width, object.id)}, {"size", {frame.height, frame.width}}}},
                 {"area", visible->pixels},
                 {"bbox", box_json(*visible)},
                 {"iscrowd", 0}});
        }
    }

    void add_panoptic(const LabelFrame& frame, const std::vector<uint32_t>& ids,
                      const std::vector<uint32_t>& semantic) {
        std::vector<uint32_t> segments(frame.pixels());
        std::map<uint32_t, int> category_of;
        std::vector<uint8_t> bytes;
        for (size_t i = 0; i < segments.size(); ++i) {
            const int object = frame.object_of(ids[i]);
            const LabelClass& label = taxonomy()[semantic[i]];
            const uint32_t id = segments[i] =
                segment_id(frame, label, object < 0 ? nullptr : &frame.objects[size_t(object)]);
            if (id != 0) category_of[id] = label.coco_id;
            bytes.insert(bytes.end(), {uint8_t(id), uint8_t(id >> 8), uint8_t(id >> 16)});
        }
        SeenObjects seen;
        seen.look(segments, 0, frame.width);
        Json infos = Json::array();
        for (const auto& [id, category] : category_of) {
            const SeenObject& visible = *seen.find(id);
            infos.push_back({{"id", id},
                             {"category_id", category},
                             {"area", visible.pixels},
                             {"bbox", box_json(visible)},
                             {"iscrowd", 0}});
        }
        panoptic_.push_back({{"image_id", image_id_}, {"file_name", frame.name + ".png"}, {"segments_info", infos}});
        PngWriter writer(folder_ + "/panoptic/" + frame.name + ".png", frame.width, frame.height, 3, 8);
        writer.write_rows(0, frame.height, bytes.data());
        writer.finish();
    }

    std::string folder_;
    int image_id_ = 0, annotation_id_ = 0;
    Json images_ = Json::array(), instances_ = Json::array(), panoptic_ = Json::array();
};

}  // namespace

std::vector<int64_t> run_lengths(const std::vector<uint32_t>& ids, int width, uint32_t id) {
    std::vector<int64_t> counts = {0};
    bool inside = false;
    const size_t columns = size_t(width), rows = ids.size() / columns;
    for (size_t x = 0; x < columns; ++x)
        for (size_t y = 0; y < rows; ++y) {
            if ((ids[y * columns + x] == id) != inside) counts.push_back(0), inside = !inside;
            ++counts.back();
        }
    return counts;
}

std::vector<uint8_t> mask_from_run_lengths(const std::vector<int64_t>& counts, int width, int height) {
    std::vector<uint8_t> mask(size_t(width) * size_t(height));
    size_t at = 0;
    uint8_t value = 0;
    for (const int64_t count : counts) {
        if (count < 0 || size_t(count) > mask.size() - at)
            throw input_error("run lengths", "are longer than the picture");
        for (int64_t k = 0; k < count; ++k, ++at)
            mask[at % size_t(height) * size_t(width) + at / size_t(height)] = value;
        value = 1 - value;
    }
    if (at != mask.size()) throw input_error("run lengths", "are shorter than the picture");
    return mask;
}

void export_coco(const std::vector<LabelSource>& frames, const std::string& folder) {
    Export target(folder);
    for (const LabelSource& source : frames) {
        LabelFrame frame(source);
        target.add(frame);
    }
    target.finish();
}

}  // namespace pluvia
