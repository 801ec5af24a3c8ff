#include "tools/learning/model_config.h"

#include "renderer/core/error.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace pluvia {
namespace {

using Json = nlohmann::json;
constexpr const char* metadata_key = "pluvia";

/// A number from the metadata within its range; value where there is none.
template <class T>
void read_number(const Json& j, const char* key, T& value, T low, T high, const std::string& where) {
    const auto found = j.find(key);
    if (found == j.end()) return;
    if (!found->is_number() || !(found->get<double>() >= double(low)) || !(found->get<double>() <= double(high)))
        throw input_error(where, fmt::format("metadata \"{}\" is not valid (got {}, expected {} to {})", key,
                                             found->dump().substr(0, 40), low, high));
    value = found->get<T>();
}

Json stored_settings(const SafetensorsFile& file) {
    const auto found = file.metadata().find(metadata_key);
    if (found == file.metadata().end()) return Json::object();
    const Json j = Json::parse(found->second, nullptr, false);
    if (!j.is_object()) throw input_error(file.path(), "metadata \"pluvia\" is not a JSON object");
    return j;
}

void check_channels(const std::string& path, const char* what, int64_t got, int64_t expected) {
    if (got != expected)
        throw input_error(path, fmt::format("{} does not fit (got {} channels, expected {})", what, got, expected));
}

}  // namespace

const char* model_kind_name(ModelConfig::Kind kind) {
    return kind == ModelConfig::Kind::regression ? "regression" : "diffusion";
}

ModelConfig model_config(const SafetensorsFile& file) {
    ModelConfig c;
    c.metadata = file.metadata();
    const std::string& path = file.path();
    const Json j = stored_settings(file);
    int64_t head_width = c.unet.head_width;
    read_number<int64_t>(j, "head_width", head_width, 1, 1024, path);
    read_number(j, "times", c.diffusion.times, 1, 1'000'000, path);
    read_number(j, "first_beta", c.diffusion.first_beta, 1e-9, 0.999, path);
    read_number(j, "last_beta", c.diffusion.last_beta, c.diffusion.first_beta, 0.999, path);
    read_number(j, "fold", c.fold, 1, 16, path);
    if (const auto tells = j.find("tells"); tells != j.end()) {
        if (*tells != "noise" && *tells != "velocity")
            throw input_error(path, fmt::format("metadata \"tells\" is not valid (got {}, expected noise or velocity)",
                                                tells->dump().substr(0, 40)));
        c.tells_velocity = *tells == "velocity";
    }
    if (j.contains("kind")) {
        const Json& kind = j["kind"];
        if (kind != "diffusion" && kind != "regression")
            throw input_error(path, fmt::format("metadata \"kind\" is not valid (got {}, expected diffusion or "
                                                "regression)",
                                                kind.dump().substr(0, 40)));
        if (kind == "regression") c.kind = ModelConfig::Kind::regression;
    }
    c.unet = unet_config(shapes_below(file.entries(), unet_prefix), head_width, path);
    if (c.kind == ModelConfig::Kind::regression) {
        c.fold = 1;
        check_channels(path, "the network's input", c.unet.in_channels, regression_channels);
        check_channels(path, "the network's output", c.unet.out_channels, 3);
        check_channels(path, "the guide", c.unet.context_channels, 0);
        return c;
    }
    const TensorShapes first_stage = shapes_below(file.entries(), first_stage_prefix);
    int64_t latent = 3 * c.fold * c.fold, condition = regression_channels * c.fold * c.fold;
    if (!first_stage.empty() || !j.contains("fold")) {
        c.first_stage = first_stage_config(first_stage, path);
        latent = condition = c.first_stage->code_channels;
        check_channels(path, "the first stage's picture", c.first_stage->image_channels, 3);
    }
    check_channels(path, "the UNet's input", c.unet.in_channels, latent + condition);
    check_channels(path, "the UNet's output", c.unet.out_channels, latent);
    const TensorShapes guide = shapes_below(file.entries(), guide_prefix);
    if (c.unet.context_channels > 0) {
        if (guide.empty()) throw input_error(path, "its UNet asks for a guiding model, and the file has none");
        c.guide = unet_config(guide, head_width, path);
        check_channels(path, "the guiding model's input", c.guide->in_channels, latent + condition);
        check_channels(path, "the guiding model's output", c.guide->out_channels, latent);
        check_channels(path, "attention to the guide", c.unet.context_channels, latent);
        check_channels(path, "the guiding model's own guide", c.guide->context_channels, 0);
    } else if (!guide.empty()) {
        c.notices.push_back(
            "the guiding model is skipped: this UNet has no attention to it, so the picture is the same without");
    }
    return c;
}

std::map<std::string, std::string> model_metadata(const ModelConfig& c) {
    Json j = {{"kind", model_kind_name(c.kind)}, {"head_width", c.unet.head_width}};
    if (c.kind == ModelConfig::Kind::diffusion) {
        j["times"] = c.diffusion.times;
        j["first_beta"] = c.diffusion.first_beta;
        j["last_beta"] = c.diffusion.last_beta;
        if (!c.first_stage) j["fold"] = c.fold;
        if (c.tells_velocity) j["tells"] = "velocity";
    }
    auto metadata = c.metadata;
    metadata[metadata_key] = j.dump();
    return metadata;
}

}  // namespace pluvia
