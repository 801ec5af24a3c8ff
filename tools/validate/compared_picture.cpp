#include "tools/validate/compared_picture.h"

#include "renderer/core/error.h"
#include "renderer/image/exr.h"
#include "renderer/image/image_io.h"
#include "tools/validate/exr_layers.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>

namespace pluvia {
namespace {

constexpr int band = 64;  // rows read at a time

/// What Pluvia, Blender and pbrt write into headers.
std::map<std::string, std::string> read_origin(const ExrAttributes& attributes) {
    std::map<std::string, std::string> origin;
    const auto text = [](const ExrAttribute& value) {
        return std::visit(
            [](const auto& v) -> std::string {
                if constexpr (requires { v + 0; })
                    return fmt::format("{}", v);
                else if constexpr (requires { v.c_str(); })
                    return v;
                else
                    return "";
            },
            value);
    };
    for (const auto& [attribute, key] : {std::pair{"pluvia:version", "pluvia"},
                                         {"pluvia:scene", "scene"},
                                         {"pluvia:scene_hash", "scene hash"},
                                         {"pluvia:camera", "camera"},
                                         {"samplesPerPixel", "samples"},
                                         {"Scene", "scene"},
                                         {"Software", "software"},
                                         {"cycles.ViewLayer.samples", "samples"}})
        if (const auto found = attributes.find(attribute); found != attributes.end()) origin[key] = text(found->second);
    if (const auto found = attributes.find("pluvia:settings"); found != attributes.end()) {
        const auto settings = nlohmann::json::parse(text(found->second), nullptr, false);
        for (const auto& [option, key] : {std::pair{"spp", "samples"}, {"seed", "seed"}})
            if (settings.is_object() && settings.contains(option)) origin[key] = settings[option].dump();
    }
    return origin;
}

void read_exr(const std::string& path, const ReadSettings& settings, ComparedPicture& picture) {
    ExrReader reader(path);
    const ExrLayer layer = find_layer(reader.channels(), settings.layer, path);
    const bool as_depth = settings.kind == "depth" || (settings.kind == "auto" && layer.is_depth);
    picture.layer = layer.name.empty() ? "RGB" : layer.name;
    picture.kind = settings.kind == "mask" ? PictureKind::mask : as_depth ? PictureKind::depth : PictureKind::light;
    picture.origin = read_origin(reader.attributes());
    const bool is_color = picture.kind == PictureKind::light;
    if (is_color)
        picture.color = Image<Rgb>(reader.width(), reader.height());
    else
        picture.value = Image<float>(reader.width(), reader.height());
    const size_t plane = size_t(reader.width()) * band;
    std::vector<std::vector<float>> values(layer.channels.size(), std::vector<float>(plane));
    std::vector<std::vector<uint32_t>> ids(layer.channels.size(), std::vector<uint32_t>(plane));
    for (int y = 0; y < reader.height(); y += band) {
        const int rows = std::min(band, reader.height() - y);
        std::vector<ExrRequest> requests;
        for (size_t c = 0; c < values.size(); ++c) {
            const auto channel = std::find_if(reader.channels().begin(), reader.channels().end(),
                                              [&](const ExrChannel& one) { return one.name == layer.channels[c]; });
            requests.push_back({channel->name, channel->is_id ? ExrRowsOut(ids[c].data()) : values[c].data()});
        }
        reader.read_rows(y, rows, requests);
        for (size_t c = 0; c < values.size(); ++c)
            if (std::holds_alternative<uint32_t*>(requests[c].rows))
                std::copy(ids[c].begin(), ids[c].end(), values[c].begin());
        const size_t first = size_t(y) * size_t(reader.width()), count = size_t(rows) * size_t(reader.width());
        for (size_t i = 0; i < count; ++i) {
            if (!is_color)
                picture.value.pixels[first + i] = values[0][i];
            else if (values.size() == 3)
                picture.color.pixels[first + i] = {values[0][i], values[1][i], values[2][i]};
            else
                picture.color.pixels[first + i] = Rgb(values[0][i]);
        }
    }
}

void read_depth(const std::string& path, const ReadSettings& settings, ComparedPicture& picture) {
    if (settings.depth_encoding == DepthEncoding::carla24) {
        const Image<Rgba8> stored = read_rgba8(path);
        picture.value = Image<float>(stored.width, stored.height);
        std::transform(stored.pixels.begin(), stored.pixels.end(), picture.value.pixels.begin(), decode_carla24);
        return;
    }
    const Image<uint16_t> stored = read_grey16(path);
    picture.value = Image<float>(stored.width, stored.height);
    std::transform(stored.pixels.begin(), stored.pixels.end(), picture.value.pixels.begin(), [&](uint16_t v) {
        switch (settings.depth_encoding) {
            case DepthEncoding::mm16:
                return decode_mm16(v);
            case DepthEncoding::hri:
                return decode_hri(v, settings.depth_max);
            default:
                return decode_kitti16(v);
        }
    });
}

void read_other(const std::string& path, const ReadSettings& settings, ComparedPicture& picture) {
    const std::string name = std::filesystem::path(path).filename();
    const bool is_auto = settings.kind == "auto";
    const ImageInfo info = read_image_info(path);
    if (settings.kind == "depth" || (is_auto && name.starts_with("depth") && !info.is_float)) {
        picture.kind = PictureKind::depth;
        read_depth(path, settings, picture);
    } else if (settings.kind == "mask" || (is_auto && name.find("mask") != std::string::npos && !info.is_float)) {
        picture.kind = PictureKind::mask;
        const Image<uint16_t> stored = read_grey16(path);
        picture.value = Image<float>(stored.width, stored.height);
        std::transform(stored.pixels.begin(), stored.pixels.end(), picture.value.pixels.begin(),
                       [](uint16_t v) { return float(v) / 65535; });
    } else if (info.is_float) {
        picture.kind = PictureKind::light;
        picture.color = read_radiance(path);
    } else {
        picture.kind = PictureKind::display;
        picture.color = read_display(path);
    }
}

}  // namespace

const char* picture_kind_name(PictureKind kind) {
    constexpr const char* names[] = {"light", "display", "depth", "mask"};
    return names[int(kind)];
}

ComparedPicture read_compared_picture(const std::string& path, const ReadSettings& settings) {
    if (!std::filesystem::exists(path)) throw input_error(path, "does not exist");
    ComparedPicture picture;
    if (is_exr(path))
        read_exr(path, settings, picture);
    else if (settings.layer.empty())
        read_other(path, settings, picture);
    else
        throw input_error(path, "has no layers (got --layer " + settings.layer + ", expected an EXR file)");
    for (size_t i = 0; i < picture.color.pixels.size(); ++i)
        if (!is_finite(picture.color.pixels[i]))
            throw input_error(path, fmt::format("holds values that are not finite (the first in column {} of row {})",
                                                i % size_t(picture.width()), i / size_t(picture.width())));
    return picture;
}

}  // namespace pluvia
