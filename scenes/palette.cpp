#include "scenes/palette.h"

#include "scenes/materials.h"

#include "renderer/core/error.h"

namespace pluvia {
namespace {

struct Pictures {
    SurfaceMaps (*paint)();
    Vec2 size;  // metres
    Wrap wrap = Wrap::repeat;
};

const std::map<std::string, Pictures>& picture_table() {
    static const std::map<std::string, Pictures> table = {
        {"red_brick", {red_brick, {1.8f, 1.8f}}},
        {"pale_brick", {pale_brick, {1.8f, 1.8f}}},
        {"sandstone", {sandstone, {2, 2}}},
        {"granite", {granite, {1.2f, 1.2f}}},
        {"asphalt", {asphalt, {2, 2}}},
        {"bark", {bark, {0.5f, 0.5f}}},
        {"sheet_metal", {sheet_metal, {1, 1}}},
        {"galvanised", {galvanised, {0.8f, 0.8f}}},
        {"plaster", {plaster, {2, 2}}},
        {"wood", {wood, {0.6f, 2.4f}}},
        {"cloth", {cloth, {0.25f, 0.25f}}},
        {"soil", {soil, {0.5f, 0.5f}}},
        {"dry_leaf", {dry_leaf, {1, 1}, Wrap::clamp}},
        {"paving", {paving_stone, {1.6f, 1.6f}}},
        {"wall_tiles", {wall_tiles, {1.2f, 1.2f}}},
    };
    return table;
}

/// A plain finish: pictures by name, and what multiplies them.
struct Recipe {
    const char* pictures;
    Rgb color = Rgb(1);
    float roughness = 1, metallic = 0;
    float enlarge = 1;  // of the pictures, so that two finishes of one set differ in grain
    float clearcoat = 0;
    bool cut_out = false;
    float transmission = 0;  // of a thin pane
};

const std::map<std::string, Recipe>& recipe_table() {
    static const std::map<std::string, Recipe> table = {
        // walls
        {"red_brick", {"red_brick", {0.8f, 0.74f, 0.74f}}},
        {"dark_red_brick", {"red_brick", {0.5f, 0.42f, 0.42f}}},
        {"orange_brick", {"red_brick"}},
        {"brown_brick", {"pale_brick", {0.55f, 0.44f, 0.36f}}},
        {"grey_brick", {"pale_brick", {0.40f, 0.44f, 0.5f}}},
        {"buff_brick", {"pale_brick"}},
        {"brownstone", {"sandstone", {0.62f, 0.40f, 0.29f}}},
        {"limestone", {"sandstone", {1.0f, 0.95f, 0.84f}}},
        {"grey_stone", {"sandstone", {0.5f, 0.51f, 0.52f}}},
        {"brown_tiles", {"wall_tiles", {0.52f, 0.36f, 0.27f}}},
        {"dark_tiles", {"wall_tiles", {0.3f, 0.28f, 0.27f}}},
        {"beige_tiles", {"wall_tiles", {0.95f, 0.85f, 0.7f}}},
        {"grey_mortar", {"plaster", {0.42f, 0.42f, 0.41f}}},
        {"dark_mortar", {"plaster", {0.2f, 0.19f, 0.185f}}},
        {"ochre_mortar", {"plaster", {0.6f, 0.48f, 0.33f}}},
        {"pale_stucco", {"plaster", {0.9f, 0.82f, 0.68f}}},
        // ground
        {"granite", {"granite"}},
        {"kerb_stone", {"granite", {0.92f, 0.95f, 1.0f}, 0.95f}},
        {"paving", {"paving", {0.62f, 0.61f, 0.59f}}},
        {"concrete", {"paving", {0.7f, 0.71f, 0.72f}, 1, 0, 1.7f}},
        {"asphalt", {"asphalt"}},
        {"asphalt_patch", {"asphalt", {0.62f, 0.63f, 0.66f}, 1, 0, 0.8f}},
        {"road_paint_white", {"paving", {1, 1, 1}, 0.85f}},
        {"road_paint_yellow", {"paving", {1, 0.66f, 0.10f}, 0.85f}},
        {"soil", {"soil"}},
        {"paver", {"paving", {0.36f, 0.33f, 0.31f}, 1, 0, 0.7f}},
        {"red_paver", {"paving", {0.42f, 0.22f, 0.16f}, 1, 0, 0.7f}},
        // wood, metal, cloth
        {"timber", {"wood", {0.85f, 0.75f, 0.68f}}},
        {"golden_oak", {"wood", {1, 0.78f, 0.46f}, 0.62f}},
        {"dark_wood", {"wood", {0.42f, 0.36f, 0.33f}, 0.9f}},
        {"white_paint", {"sheet_metal", {1, 0.98f, 0.93f}, 0.8f, 0, 2.3f}},
        {"cream_paint", {"sheet_metal", {0.98f, 0.9f, 0.72f}, 0.8f, 0, 2.3f}},
        {"green_paint", {"sheet_metal", {0.13f, 0.22f, 0.16f}, 0.75f, 0, 2.3f}},
        {"black_paint", {"sheet_metal", {0.075f, 0.075f, 0.08f}, 0.7f, 0, 2.3f}},
        {"grey_paint", {"sheet_metal", {0.42f, 0.43f, 0.45f}, 0.8f, 0, 2.3f}},
        {"blue_paint", {"sheet_metal", {0.10f, 0.17f, 0.36f}, 0.7f, 0, 2.3f}},
        {"red_paint", {"sheet_metal", {0.62f, 0.075f, 0.05f}, 0.7f, 0, 2.3f}},
        {"yellow_paint", {"sheet_metal", {1, 0.62f, 0.08f}, 0.75f, 0, 2.3f}},
        {"zinc", {"galvanised", Rgb(1), 1, 1}},
        {"iron", {"sheet_metal", {0.11f, 0.105f, 0.1f}, 0.85f}},
        {"cast_iron", {"sheet_metal", {0.25f, 0.24f, 0.23f}, 0.95f}},
        {"aluminium", {"galvanised", {0.85f, 0.85f, 0.85f}, 1, 1, 1.6f}},
        {"bronze_frame", {"sheet_metal", {0.12f, 0.09f, 0.07f}, 0.6f, 0, 2.3f}},
        {"shutter", {"sheet_metal", {0.62f, 0.63f, 0.62f}, 0.85f, 0, 1.4f}},
        {"brass", {"", {0.75f, 0.55f, 0.25f}, 0.3f, 1}},
        {"chrome", {"", {0.62f, 0.62f, 0.63f}, 0.12f, 1}},
        {"awning_cloth", {"cloth", Rgb(1)}},
        {"rubber", {"", Rgb(0.025f), 0.75f}},
        {"dark", {"", Rgb(0.015f), 0.9f}},
        {"bark", {"bark"}},
        {"dry_leaf", {"dry_leaf", Rgb(1), 1, 0, 1, 0, true}},
        {"porcelain", {"", {0.62f, 0.61f, 0.58f}, 0.25f}},
        {"shop_glass", {"", {0.96f, 0.98f, 0.97f}, 0, 0, 1, 0, false, 1}},
        {"dark_glass", {"", {0.012f, 0.014f, 0.016f}, 0.04f}},
        // cars
        {"car_black", {"", Rgb(0.012f), 0.5f, 0, 1, 1}},
        {"car_silver", {"", {0.42f, 0.43f, 0.45f}, 0.4f, 0.7f, 1, 1}},
        {"car_red", {"", {0.28f, 0.016f, 0.014f}, 0.5f, 0, 1, 1}},
        {"car_blue", {"", {0.018f, 0.04f, 0.11f}, 0.45f, 0.3f, 1, 1}},
        {"car_white", {"", {0.7f, 0.7f, 0.68f}, 0.5f, 0, 1, 1}},
        {"car_yellow", {"", {0.72f, 0.36f, 0.02f}, 0.5f, 0, 1, 1}},
        {"car_green", {"", {0.02f, 0.075f, 0.05f}, 0.45f, 0.2f, 1, 1}},
        {"head_lamp", {"", Rgb(0.6f), 0.15f, 0.6f}},
        {"tail_lamp", {"", {0.35f, 0.012f, 0.008f}, 0.12f}},
        {"amber_lamp", {"", {0.6f, 0.2f, 0.01f}, 0.12f}},
    };
    return table;
}

}  // namespace

const MapTextures& Palette::pictures(const std::string& name) {
    const auto found = pictures_.find(name);
    if (found != pictures_.end()) return found->second;
    const Pictures& p = picture_table().at(name);
    return pictures_[name] = add_textures(street_.scene, p.paint(), p.wrap);
}

int Palette::operator()(const std::string& name) {
    const auto found = finishes_.find(name);
    if (found != finishes_.end()) return found->second;
    const auto entry = recipe_table().find(name);
    if (entry == recipe_table().end())
        throw input_error("palette", "finish is not known (got \"" + name + "\", expected one of palette.cpp)");
    const Recipe& r = entry->second;
    Material m = matte(name, r.color, r.roughness);
    m.metallic = r.metallic;
    m.clearcoat = r.clearcoat;
    m.clearcoat_roughness = 0.03f;
    m.transmission = r.transmission;
    m.alpha_mode = r.cut_out ? AlphaMode::mask : AlphaMode::opaque;
    m.double_sided = r.cut_out || r.transmission > 0;
    const std::string set = r.pictures;
    if (set.empty()) return finishes_[name] = add_finish(street_, m);
    return finishes_[name] = add_finish(street_, m, pictures(set), picture_table().at(set).size * r.enlarge);
}

int Palette::operator()(const std::string& name, const std::function<Material(Scene&)>& make) {
    const auto found = finishes_.find(name);
    if (found != finishes_.end()) return found->second;
    return finishes_[name] = add_finish(street_, make(street_.scene));
}

}  // namespace pluvia
