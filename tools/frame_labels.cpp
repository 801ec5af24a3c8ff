#include "tools/frame_labels.h"

#include "renderer/core/error.h"
#include "renderer/scene/camera.h"
#include "renderer/transport/cryptomatte.h"
#include "tools/dataset/suggestion.h"
#include "tools/frame_render.h"

#include <fmt/format.h>

namespace pluvia {

LabelChoice label_choice(const std::vector<std::string>& names) {
    LabelChoice choice;
    LabelLayers& l = choice.layers;
    const std::vector<std::pair<std::string, bool*>> known = {
        {"semantic", &l.semantic}, {"instance", &l.instance},      {"normals", &l.normals},
        {"albedo", &l.albedo},     {"position", &l.position},      {"flow", &l.flow},
        {"boxes", &choice.boxes},  {"cryptomatte", &l.cryptomatte}};
    for (const std::string& name : names) {
        bool found = false;
        for (const auto& [key, value] : known)
            if (name == "all" || name == key) *value = found = true;
        if (found) continue;
        std::vector<std::string> keys = {"all"};
        for (const auto& [key, value] : known) keys.push_back(key);
        const std::string near = nearest_word(name, keys);
        throw usage_error("--layers",
                          fmt::format("there is no layer \"{}\" (expected {}){}", name, fmt::join(keys, ", "),
                                      near.empty() ? "" : "; did you mean " + near + "?"));
    }
    if (choice.boxes) l.instance = true;
    return choice;
}

std::shared_ptr<const SceneObjects> objects_of(const FrameScene& frame, const LabelChoice& choice,
                                               const std::vector<LabelRule>& rules) {
    if (!choice.layers.any_id() && !choice.layers.cryptomatte) return nullptr;
    return std::make_shared<const SceneObjects>(label_objects(frame.scene, frame.labelled_paths, rules));
}

void set_other_frames(const FrameScene& frame, const RenderOptions& options, const FrameSettings& settings,
                      const View& view, LabelSettings& labels) {
    if (!labels.layers.flow) return;
    const auto other = [&](const std::shared_ptr<const Scene>& scene, int step) -> OtherFrame {
        if (!scene) return {nullptr, view};
        CameraSettings camera = settings.camera;
        camera.mid_exposure += step / options.fps;
        const std::shared_ptr<const Scene> moved = scene->instances.empty() ? nullptr : scene;
        // A camera that frames the scene does not follow what moves in it.
        return {moved, scene->cameras.empty() ? view : make_view(find_camera(*scene, options.camera), camera)};
    };
    labels.next = other(frame.next, 1), labels.previous = other(frame.previous, -1);
}

std::map<std::string, std::string> label_header(const Scene& scene, const LabelSettings& labels,
                                                const std::vector<double>& intensities) {
    std::map<std::string, std::string> header;
    if (!labels.layers.cryptomatte) return header;
    std::vector<std::string> objects, materials;
    for (const LabelObject& object : labels.objects->objects) objects.push_back(object.name);
    for (const Material& material : scene.materials) materials.push_back(material.name);
    header.merge(cryptomatte_header("CryptoObject", objects));
    header.merge(cryptomatte_header("CryptoMaterial", materials));
    for (const double intensity : intensities)
        header.merge(cryptomatte_header(rain_matte_layer(intensity_label(intensity)), {"rain"}));
    return header;
}

}  // namespace pluvia
