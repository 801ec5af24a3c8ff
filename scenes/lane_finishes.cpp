// Materials of the lane with their measures: albedo, roughness, luminance of what is lit.
#include "scenes/brush.h"
#include "scenes/lane.h"
#include "scenes/materials.h"
#include "scenes/noise.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pluvia::lane {
namespace {

Material cut_out(const char* name, Rgb base_color, const MapTextures& textures) {
    Material m = matte(name, base_color);
    m.base_color_texture = textures.base_color;
    m.alpha_mode = AlphaMode::mask;
    m.double_sided = true;
    return m;
}

float ink_at(const Ink& ink, float x, float y) {
    return ink.at(std::clamp(int(x * float(ink.width)), 0, ink.width - 1),
                  std::clamp(int(y * float(ink.height)), 0, ink.height - 1));
}

/// Sheet of one colour written on in another.
Image<Rgba8> written(const Ink& ink, Rgb sheet, Rgb writing) {
    return paint_color(ink.width, ink.height, [&](float x, float y) { return mix(sheet, writing, ink_at(ink, x, y)); });
}

/// Paper window from inside: brighter in the middle, wooden bars, the shade of something on the sill.
Image<Rgba8> window_picture(uint64_t seed) {
    return paint_color(256, 256, [seed](float x, float y) {
        const float glow = std::exp(-2.2f * ((x - 0.5f) * (x - 0.5f) + (y - 0.4f) * (y - 0.4f)));
        const float cloud = fractal_noise({x * 4, y * 4}, 4, 4, 3, seed);
        const float bars = std::max(bump(x * 4 - std::round(x * 4), 0.05f), bump(y * 5 - std::round(y * 5), 0.06f));
        const float skyline = 0.8f + 0.14f * noise({x * 6, 0.5f}, 6, 1, seed + 7);
        const float shade = smooth_step(skyline, skyline + 0.05f, y);
        const float v = glow * (0.75f + 0.4f * cloud) * (1 - 0.75f * bars) * (1 - 0.6f * shade);
        return Rgb(1, 0.97f, 0.92f) * std::min(v, 1.0f);
    });
}

/// Around the lantern once, top to bottom: ribs of bamboo, light strongest at mid-height, characters at two sides.
Image<Rgba8> lantern_picture(const std::vector<std::string>& names, Rgb paper, Rgb writing) {
    Ink ink(1024, 512);
    for (const float x : {256.0f, 768.0f}) write_column(ink, names, x, 70, 442, 0.14f);
    return paint_color(512, 256, [&](float x, float y) {
        const float rib = bump(y * 22 - std::round(y * 22), 0.12f);
        const float fibre = fractal_noise({x * 60, y * 30}, 60, 30, 3, 7);
        const float glow = 0.5f + 0.5f * std::exp(-8 * (y - 0.55f) * (y - 0.55f));
        return mix(paper, writing, ink_at(ink, x, y)) * (glow * (1 - 0.35f * rib) * (0.8f + 0.2f * fibre));
    });
}

int picture(Street& street, Image<Rgba8> image) {
    return add_texture(street.scene, std::move(image), Wrap::clamp);
}

void add_wood_and_walls(Street& street, Finishes& f) {
    const MapTextures grain = add_textures(street.scene, wood());
    const auto timber = [&](const char* name, Rgb color, float roughness = 1) {
        return add_finish(street, matte(name, color, roughness), grain, {0.6f, 2.4f});
    };
    f.red_wood = timber("red_wood", {1.0f, 0.60f, 0.47f});
    f.brown_wood = timber("brown_wood", {0.72f, 0.56f, 0.46f});
    f.dark_wood = timber("dark_wood", {0.42f, 0.36f, 0.33f}, 0.9f);
    f.grey_wood = timber("grey_wood", {0.68f, 0.78f, 0.88f});
    f.bamboo = timber("bamboo", {1.0f, 0.86f, 0.62f}, 0.8f);

    const MapTextures wall = add_textures(street.scene, plaster());
    f.ochre_plaster = add_finish(street, matte("ochre_plaster", {0.98f, 0.80f, 0.50f}), wall, {2, 2});
    f.white_plaster = add_finish(street, matte("white_plaster", {0.97f, 0.96f, 0.94f}), wall, {2, 2});

    const MapTextures stone = add_textures(street.scene, granite());
    f.granite = add_finish(street, matte("granite", Rgb(1)), stone, {1.2f, 1.2f});
    f.concrete = add_finish(street, matte("concrete", Rgb(0.95f, 0.97f, 1.0f)), stone, {2.9f, 2.9f});
    f.soil = add_finish(street, matte("soil", Rgb(1)), add_textures(street.scene, soil()), {0.5f, 0.5f});
    f.clay = add_finish(street, matte("clay", Rgb(1)), add_textures(street.scene, clay()), {0.8f, 0.8f});
    f.tiled_roof =
        add_finish(street, matte("tiled_roof", Rgb(1)), add_textures(street.scene, tiled_roof()), {1.06f, 0.94f});
}

void add_metals(Street& street, Finishes& f) {
    const MapTextures sheet = add_textures(street.scene, sheet_metal());
    // Weathered sheet is oxide and paint over metal: a dielectric to the eye.
    f.copper = add_finish(street, matte("copper", {0.50f, 0.33f, 0.24f}, 0.8f), sheet, {1, 1});
    f.zinc = add_finish(street, matte("zinc", {0.62f, 0.64f, 0.66f}, 0.8f), sheet, {1, 1});
    f.painted_metal = add_finish(street, matte("painted_metal", {1.0f, 0.98f, 0.92f}, 1), sheet, {1, 1});
    f.iron = add_finish(street, matte("iron", {0.05f, 0.048f, 0.045f}, 0.45f));
    f.rubber = add_finish(street, matte("rubber", {0.03f, 0.03f, 0.03f}, 0.7f));
    f.glass = add_finish(street, matte("glass", {0.03f, 0.035f, 0.04f}, 0.06f));
    f.terracotta = add_finish(street, matte("terracotta", {0.34f, 0.15f, 0.09f}, 0.85f));
    f.porcelain = add_finish(street, matte("porcelain", {0.62f, 0.61f, 0.58f}, 0.25f));
}

void add_soft(Street& street, Finishes& f) {
    const MapTextures weave = add_textures(street.scene, cloth());
    f.indigo_cloth = add_finish(street, matte("indigo_cloth", {0.05f, 0.075f, 0.16f}), weave, {0.25f, 0.25f});
    f.red_cloth = add_finish(street, matte("red_cloth", {0.45f, 0.06f, 0.05f}), weave, {0.25f, 0.25f});
    const MapTextures blade = add_textures(street.scene, leaf(), Wrap::clamp);
    f.leaf = add_finish(street, cut_out("leaf", {1, 1, 1}, blade), blade);
    f.dark_leaf = add_finish(street, cut_out("dark_leaf", {0.7f, 0.62f, 0.75f}, blade), blade);
    const MapTextures feather = add_textures(street.scene, frond(), Wrap::clamp);
    f.frond = add_finish(street, cut_out("frond", {1, 1, 1}, feather), feather);
}

void add_lit(Street& street, Finishes& f) {
    const auto lit = [&](const char* name, Rgb base_color, Rgb emission, Image<Rgba8> image) {
        return add_finish(street, glowing(name, base_color, emission, picture(street, std::move(image))));
    };
    f.lit_window = lit("lit_window", Rgb(0.6f), nits(halogen, 180), window_picture(101));
    f.warm_window = lit("warm_window", Rgb(0.6f), nits(incandescent, 110), window_picture(102));
    Material lamp = matte("lamp_glass", Rgb(0.8f), 0.3f);
    lamp.emission = nits(halogen, 4500);
    f.lamp_glass = add_finish(street, lamp);
    f.white_lantern = lit("white_lantern", Rgb(0.7f), nits(incandescent, 1100),
                          lantern_picture({"yama", "tsuki"}, {1, 0.95f, 0.85f}, {0.03f, 0.02f, 0.02f}));
    f.red_lantern = lit("red_lantern", Rgb(0.7f), nits(incandescent, 1400),
                        lantern_picture({"sake"}, {1, 0.16f, 0.07f}, {0.02f, 0.01f, 0.01f}));

    Ink panel(512, 768);  // the standing sign by the door
    write_column(panel, {"tsuki", "no", "ya"}, 200, 70, 560, 0.135f);
    write_column(panel, {"cha", "sake"}, 390, 90, 400, 0.1f);
    draw_line(panel, {130, 660}, {400, 660}, 22);
    draw_line(panel, {130, 660}, {180, 615}, 22);
    f.lit_sign = lit("lit_sign", Rgb(0.8f), nits(fluorescent, 420), written(panel, Rgb(1), Rgb(0.006f)));
    Ink column(256, 768);
    write_column(column, {"hana", "no", "ki"}, 128, 60, 560, 0.125f);
    draw_line(column, {60, 640}, {196, 640}, 8);
    draw_line(column, {84, 690}, {172, 690}, 8);
    f.lit_sign_tall = lit("lit_sign_tall", Rgb(0.8f), nits(fluorescent, 380), written(column, Rgb(1), Rgb(0.006f)));
    Ink box(256, 512);
    write_column(box, {"sake", "ya"}, 128, 40, 470, 0.11f);
    f.lit_sign_box =
        lit("lit_sign_box", Rgb(0.8f), nits(halogen, 480), written(box, {1, 0.86f, 0.6f}, {0.12f, 0.004f, 0.004f}));
    for (const int finish : {f.lit_window, f.warm_window, f.lamp_glass, f.white_lantern, f.red_lantern, f.lit_sign,
                             f.lit_sign_tall, f.lit_sign_box})
        street.scene.materials[size_t(street.finishes[size_t(finish)].material)].lamp = true;
}

void add_signs(Street& street, Finishes& f) {
    Ink board(384, 1024);
    write_column(board, {"yama", "hon", "cha", "ya"}, 160, 60, 960, 0.115f);
    write_column(board, {"dai", "ko", "no", "san", "tsuki"}, 330, 90, 640, 0.09f);
    Image<Rgba8> wooden = paint_color(384, 1024, [&](float x, float y) {
        const float grain = fractal_noise({x * 50, y * 4}, 50, 4, 4, 301);
        return mix(Rgb(0.13f, 0.055f, 0.032f) * (0.5f + grain), Rgb(0.72f, 0.7f, 0.66f), ink_at(board, x, y));
    });
    const auto print = [&](const char* name, Image<Rgba8> image, float roughness) {
        Material m = matte(name, Rgb(1), roughness);
        m.base_color_texture = picture(street, std::move(image));
        return add_finish(street, m);
    };
    f.signboard = print("signboard", std::move(wooden), 0.6f);

    Ink plate(128, 384);
    write_column(plate, {"ishi", "i"}, 64, 40, 340);
    f.nameplate = print("nameplate", written(plate, {0.42f, 0.32f, 0.2f}, {0.03f, 0.03f, 0.03f}), 0.6f);

    Ink note(256, 384);
    draw_ring(note, {128, 120}, 66, 12);
    draw_line(note, {82, 166}, {174, 74}, 12);
    write_column(note, {"kawa", "ta"}, 128, 210, 370);
    f.poster = print("poster", written(note, {0.62f, 0.6f, 0.55f}, {0.3f, 0.03f, 0.03f}), 0.8f);

    Ink curtain(1024, 512);
    draw_ring(curtain, {512, 200}, 120, 26);
    write_glyph(curtain, "yama", {436, 128}, 150, 0.12f);
    for (const auto& [x, name] : {std::pair{150.0f, "cha"}, std::pair{724.0f, "ya"}})
        write_glyph(curtain, name, {x, 130}, 150, 0.11f);
    f.noren_print = print("noren_print", written(curtain, {0.035f, 0.05f, 0.12f}, Rgb(0.68f)), 0.95f);
}

}  // namespace

Finishes add_finishes(Street& street) {
    Finishes f = {};
    add_wood_and_walls(street, f);
    add_metals(street, f);
    add_soft(street, f);
    add_lit(street, f);
    add_signs(street, f);
    return f;
}

}  // namespace pluvia::lane
