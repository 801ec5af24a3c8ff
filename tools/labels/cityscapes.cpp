#include "renderer/core/error.h"
#include "renderer/image/image_io.h"
#include "tools/frame_file.h"
#include "tools/labels/label_export.h"
#include "tools/labels/outline.h"

#include <fmt/format.h>

namespace pluvia {
namespace {

template <class Word>
void write_png(const std::string& path, const LabelFrame& frame, int channels, const std::vector<Word>& values) {
    PngWriter writer(path, frame.width, frame.height, channels, 8 * int(sizeof(Word)));
    writer.write_rows(0, frame.height, values.data());
    writer.finish();
}

/// The class as Cityscapes knows it.
const LabelClass& in_cityscapes(int class_id) {
    return taxonomy()[size_t(taxonomy()[size_t(class_id)].cityscapes_id)];
}

uint16_t instance_code(const LabelFrame& frame, const FrameObject& object) {
    const LabelClass& label = in_cityscapes(object.class_id);
    if (!object.label().countable) return uint16_t(label.id);
    if (object.number > 999)
        throw input_error(frame.path, fmt::format("has too many objects of class {} for Cityscapes (got number {}, "
                                                  "expected up to 999)",
                                                  label.name, object.number));
    return uint16_t(label.id * 1000 + object.number);
}

nlohmann::ordered_json polygons(const LabelFrame& frame, const std::vector<uint32_t>& instance) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const Outline& outline : outlines(instance, frame.width)) {
        const int object = frame.object_of(outline.id);
        const int class_id = object < 0 ? sky_id : frame.objects[size_t(object)].class_id;
        list.push_back({{"label", in_cityscapes(class_id).name}, {"polygon", outline.points}});
    }
    return {{"imgHeight", frame.height}, {"imgWidth", frame.width}, {"objects", list}};
}

}  // namespace

void export_cityscapes(LabelFrame& frame, const std::string& folder) {
    const std::vector<uint32_t> semantic = frame.ids("semantic.ID"), instance = frame.ids("instance.ID");
    std::vector<uint16_t> code_of_object;
    for (const FrameObject& object : frame.objects) code_of_object.push_back(instance_code(frame, object));
    std::vector<uint8_t> ids, train_ids, color;
    std::vector<uint16_t> instances;
    for (size_t i = 0; i < frame.pixels(); ++i) {
        const LabelClass& label = in_cityscapes(int(semantic[i]));
        ids.push_back(uint8_t(label.id)), train_ids.push_back(uint8_t(label.train_id));
        color.insert(color.end(), label.color.begin(), label.color.end());
        const int object = frame.object_of(instance[i]);
        instances.push_back(object < 0 ? uint16_t(label.id) : code_of_object[size_t(object)]);
    }
    const std::string stem = folder + "/" + frame.name + "_gtFine_";
    write_png(stem + "labelIds.png", frame, 1, ids);
    write_png(stem + "labelTrainIds.png", frame, 1, train_ids);
    write_png(stem + "instanceIds.png", frame, 1, instances);
    write_png(stem + "color.png", frame, 3, color);
    write_text(stem + "polygons.json", json_text(polygons(frame, instance)) + "\n");
}

}  // namespace pluvia
