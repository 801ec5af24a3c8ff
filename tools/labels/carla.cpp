#include "renderer/core/error.h"
#include "renderer/image/depth_encoding.h"
#include "renderer/image/image_io.h"
#include "tools/labels/label_export.h"

#include <fmt/format.h>

#include <filesystem>

namespace pluvia {
namespace {

void write_png(const std::string& folder, const LabelFrame& frame, const std::vector<uint8_t>& values) {
    std::filesystem::create_directories(folder);
    PngWriter writer(folder + "/" + frame.name + ".png", frame.width, frame.height, 3, 8);
    writer.write_rows(0, frame.height, values.data());
    writer.finish();
}

}  // namespace

void export_carla(LabelFrame& frame, const std::string& folder, bool before_0_9_14) {
    const std::vector<uint32_t> semantic = frame.ids("semantic.ID"), instance = frame.ids("instance.ID");
    const std::vector<float> z = frame.values("Z");
    std::vector<uint8_t> tags, instances, depth;
    for (size_t i = 0; i < frame.pixels(); ++i) {
        const LabelClass& label = taxonomy()[semantic[i]];
        const auto tag = uint8_t(before_0_9_14 ? label.carla_tag_before_0_9_14 : label.carla_tag);
        const int object = frame.object_of(instance[i]);
        const int number = object < 0 ? 0 : frame.objects[size_t(object)].index + 1;
        if (number > 65535)
            throw input_error(frame.path,
                              fmt::format("has too many objects for CARLA's 16 bits (got number {})", number));
        const Rgba8 metres = encode_carla24(z[i]);
        tags.insert(tags.end(), {tag, 0, 0});
        instances.insert(instances.end(), {tag, uint8_t(number), uint8_t(number >> 8)});
        depth.insert(depth.end(), {metres.r, metres.g, metres.b});
    }
    write_png(folder + "/semantic", frame, tags);
    write_png(folder + "/instance", frame, instances);
    write_png(folder + "/depth", frame, depth);
}

}  // namespace pluvia
