#include "scenes/lit_signs.h"

#include "scenes/brush.h"
#include "scenes/characters.h"
#include "scenes/materials.h"
#include "scenes/noise.h"

#include <algorithm>
#include <cmath>

namespace pluvia {
namespace {

void print_frame(Ink& ink, float margin, float width) {
    const float w = float(ink.width), h = float(ink.height);
    draw_line(ink, {margin, margin}, {w - margin, margin}, width);
    draw_line(ink, {w - margin, margin}, {w - margin, h - margin}, width);
    draw_line(ink, {w - margin, h - margin}, {margin, h - margin}, width);
    draw_line(ink, {margin, h - margin}, {margin, margin}, width);
}

Image<Rgba8> sign_picture(const SignPrint& p) {
    const int height = p.aspect > 1.6f   ? 128
                       : p.aspect > 0.7f ? 256
                                         : 384,
              width = std::max(48, int(float(height) * p.aspect) / 4 * 4);
    const float w = float(width), h = float(height), small = p.latin.empty() ? 0.0f : 0.1f * h;
    Ink letters(width, height), trim(width, height);
    const float margin = 0.05f * std::min(w, h);
    if (p.framed) print_frame(trim, margin, 0.035f * std::min(w, h));
    const float top = 1.9f * margin, bottom = h - 1.9f * margin - small;
    const size_t n = p.columns.size();
    for (size_t i = 0; i < n; ++i) {
        const float x = w * (1 - (float(i) + 0.5f) / float(n)) + (n > 1 ? (i == 0 ? -1.0f : 1.0f) * 0.03f * w : 0.0f);
        // Characters keep their shape: a short column does not fill the height.
        const float pitch = std::min((bottom - top) / float(p.columns[i].size()), 0.98f * w / float(n));
        const float used = pitch * float(p.columns[i].size()),
                    start = i == 0 ? top + 0.5f * (bottom - top - used) : top;
        if (p.spot && i == 0) draw_ring(trim, {x, start + 0.5f * pitch}, 0.52f * pitch, 0);
        write_column(letters, p.columns[i], x, start, start + used, 0.125f);
    }
    if (!p.row.empty()) {
        const float size = std::min(bottom - top, 0.88f * w / float(p.row.size())),
                    start = 0.5f * (w - size * float(p.row.size()));
        for (size_t i = 0; i < p.row.size(); ++i)
            write_glyph(letters, p.row[i], {start + size * (float(i) + 0.06f), 0.5f * (top + bottom - 0.88f * size)},
                        0.88f * size, 0.12f);
    }
    if (!p.latin.empty()) {
        const float size = std::min(0.7f * small, 0.8f * w / std::max(0.5f, text_width(p.latin, 1)));
        write_text(letters, p.latin, {0.5f * w, bottom + 0.5f * small}, size, 0.16f * size);
    }
    return paint_color(width, height, [&](float x, float y) {
        const int i = std::min(int(x * w), width - 1), j = std::min(int(y * h), height - 1);
        // Tubes behind the sheet make it brighter along two lines.
        const float tubes = 0.8f + 0.2f * std::max(bump(x - 0.3f, 0.25f), bump(x - 0.7f, 0.25f));
        return mix(mix(p.sheet, p.border, trim.at(i, j)), p.writing, letters.at(i, j)) * tubes;
    });
}

void add_printed(Shape& shape, float left, float right, float bottom, float top, float z) {
    add_quad(shape, {Vec3{left, bottom, z}, {right, bottom, z}, {right, top, z}, {left, top, z}}, {0, 1}, {1, 0});
}

/// Frame of a box sign: four bars and the depth between the faces.
void add_case(Shape& shape, float left, float right, float bottom, float top, float back, float front) {
    constexpr float rim = 0.035f;
    add_box(shape, {left - rim, bottom - rim, back}, {left, top + rim, front}, {}, 0.006f);
    add_box(shape, {right, bottom - rim, back}, {right + rim, top + rim, front}, {}, 0.006f);
    add_box(shape, {left, bottom - rim, back}, {right, bottom, front}, {}, 0.006f);
    add_box(shape, {left, top, back}, {right, top + rim, front}, {}, 0.006f);
}

}  // namespace

int sign_finish(Palette& palette, const SignPrint& p) {
    return palette("sign_" + p.name, [&](Scene& scene) {
        const int picture = add_texture(scene, sign_picture(p), Wrap::clamp);
        Material m = glowing("sign_" + p.name, Rgb(0.75f), nits(fluorescent, p.luminance), picture);
        m.roughness = 0.25f;
        m.lamp = true;
        return m;
    });
}

Assembly projecting_sign(Palette& palette, const SignPrint& print, float width, float height) {
    Assembly a;
    constexpr float gap = 0.16f, half_depth = 0.11f;
    Assembly box;
    for (const double turn : {0.0, double(pi)}) {
        Shape face;
        add_printed(face, -0.5f * width, 0.5f * width, 0, height, half_depth - 0.012f);
        append(box[sign_finish(palette, print)], face, rotate_y(turn));
    }
    add_case(box[palette("grey_paint")], -0.5f * width, 0.5f * width, 0, height, -half_depth, half_depth);
    // From the wall at z = 0 it reaches out along +z: its faces look along the street.
    append(a, box, translate({0, 0, gap + 0.5 * width}) * rotate_y(pi / 2));
    for (const float y : {0.18f * height, 0.82f * height}) {
        add_tube(a[palette("iron")], {{0, y, 0}, {0, y, gap}}, 0.025f, 7);
        add_box(a[palette("iron")], {-0.06f, y - 0.09f, 0}, {0.06f, y + 0.09f, 0.012f});
    }
    return a;
}

Assembly wall_sign(Palette& palette, const SignPrint& print, float width, float height) {
    Assembly a;
    add_printed(a[sign_finish(palette, print)], -0.5f * width, 0.5f * width, 0, height, 0.155f);
    add_case(a[palette("grey_paint")], -0.5f * width, 0.5f * width, 0, height, 0.01f, 0.17f);
    return a;
}

Assembly castor_sign(Palette& palette, const SignPrint& print, float width, float height) {
    Assembly a;
    constexpr float foot = 0.14f;
    for (const double turn : {0.0, double(pi)}) {
        Shape face;
        add_printed(face, -0.5f * width, 0.5f * width, foot, foot + height, 0.09f);
        append(a[sign_finish(palette, print)], face, rotate_y(turn));
    }
    add_case(a[palette("grey_paint")], -0.5f * width, 0.5f * width, foot, foot + height, -0.1f, 0.1f);
    const float half = 0.5f * width + 0.08f;
    Shape& iron = a[palette("iron")];
    for (const float z : {-0.26f, 0.26f})
        add_box(iron, {-half, 0.06f, z - 0.02f}, {half, 0.095f, z + 0.02f}, {}, 0.005f);
    for (const float x : {-half + 0.05f, half - 0.05f})
        add_box(iron, {x - 0.02f, 0.06f, -0.26f}, {x + 0.02f, 0.095f, 0.26f}, {}, 0.005f);
    for (const float x : {-half + 0.03f, half - 0.03f})
        for (const float z : {-0.26f, 0.26f})
            add_tube(a[palette("rubber")], {{x - 0.012f, 0.03f, z}, {x + 0.012f, 0.03f, z}}, 0.03f, 12);
    return a;
}

Assembly neon_sign(Palette& palette, const std::vector<std::string>& characters, float size, const std::string& hue) {
    static const std::map<std::string, Rgb> hues = {{"red", {1, 0.06f, 0.03f}}, {"orange", {1, 0.25f, 0.03f}},
                                                    {"blue", {0.08f, 0.3f, 1}}, {"pink", {1, 0.12f, 0.45f}},
                                                    {"green", {0.1f, 1, 0.3f}}, {"white", {1, 0.85f, 0.7f}}};
    Assembly a;
    const int tube = palette("neon_" + hue, [&](Scene&) {
        Material m = matte("neon_" + hue, Rgb(0.6f), 0.3f);
        m.emission = nits(hues.at(hue), 600);
        m.lamp = true;
        return m;
    });
    const float pitch = 1.08f * size;
    float top = pitch * float(characters.size());
    add_box(a[palette("dark")], {-0.62f * size, -0.06f * size, 0.03f}, {0.62f * size, top + 0.02f, 0.07f}, {}, 0.01f);
    for (const std::string& name : characters) {
        for (const Stroke& stroke : strokes_of(name)) {
            std::vector<Vec3> path;
            for (const Vec2 p : smoothed(stroke, 14))
                path.push_back({(0.01f * p.x - 0.5f) * size, top - 0.04f * size - 0.01f * p.y * size, 0.12f});
            add_tube(a[tube], rounded(path, 0.03f * size, 2), 0.021f * size, 6);
        }
        top -= pitch;
    }
    flatten_creases(a[tube]);
    return a;
}

Assembly tenant_list(Palette& palette, uint64_t seed, int rows) {
    static const Rgb sheets[] = {
        {1, 0.95f, 0.9f}, {0.95f, 0.7f, 0.05f}, {0.1f, 0.5f, 0.15f}, {0.85f, 0.1f, 0.06f}, {0.1f, 0.35f, 0.8f}};
    static const std::vector<std::vector<std::string>> rows_of = {
        {"hana", "tsuki"}, {"ku", "ra", "bar"}, {"men", "dai"}, {"su", "na", "ku"}, {"sake", "kawa"}};
    Assembly a;
    Chance chance{hash_key(seed, 51)};
    constexpr float width = 0.62f, height = 0.26f;
    for (int i = 0; i < rows; ++i) {
        const int which = int(chance(0, 5));
        SignPrint print = {.name = "tenant_" + std::to_string(which),
                           .row = rows_of[size_t(which)],
                           .sheet = sheets[which],
                           .writing = which == 0 || which == 1 ? Rgb(0.03f) : Rgb(0.95f),
                           .framed = false,
                           .aspect = width / height,
                           .luminance = 100};
        const float y = (height + 0.02f) * float(i);
        add_printed(a[sign_finish(palette, print)], -0.5f * width, 0.5f * width, y, y + height, 0.11f);
    }
    add_case(a[palette("grey_paint")], -0.5f * width, 0.5f * width, 0, (height + 0.02f) * float(rows) - 0.02f, 0,
             0.12f);
    add_box(a[palette("dark")], {-0.5f * width, 0, 0}, {0.5f * width, (height + 0.02f) * float(rows) - 0.02f, 0.105f});
    return a;
}

}  // namespace pluvia
