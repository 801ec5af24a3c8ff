#include "scenes/car.h"

#include "scenes/car_lamps.h"
#include "scenes/car_outline.h"
#include "scenes/characters.h"
#include "scenes/materials.h"
#include "scenes/noise.h"

#include "renderer/core/units.h"

#include <algorithm>
#include <cmath>

namespace pluvia {
namespace {

constexpr float wheel_radius = 0.32f, arch_radius = 0.385f, floor_height = 0.2f;

class CarBuilder : CarOutline {
public:
    CarBuilder(Palette& palette, const CarShape& shape, const std::string& paint)
        : CarOutline(shape), p_(palette), paint_(palette(paint)) {}

    Assembly build() {
        body();
        cabin();
        wheels();
        fittings();
        for (const int finish : {paint_, p_("dark_glass")}) flatten_creases(a_[finish]);
        return std::move(a_);
    }

private:
    float axle(bool is_front) const { return is_front ? front() - 0.86f : -front() + 0.92f; }

    float lower(float z) const {
        float y = floor_height + 0.06f * smooth_step(front() - 0.5f, front(), std::abs(z));
        for (const bool is_front : {true, false}) {
            const float d = z - axle(is_front);
            if (std::abs(d) < arch_radius)
                y = std::max(y, wheel_radius + std::sqrt(arch_radius * arch_radius - d * d) - 0.01f);
        }
        return y;
    }
    /// Half cross-section at z, u from 0 (sill) over the shoulder to 1 (middle of the deck): (x, y).
    Vec2 section(float z, float u) const {
        const float w = 0.5f * c_.width * rounding(z), low = lower(z), top = belt(z), h = top - low;
        const Vec2 points[] = {
            {0.955f * w, low}, {0.985f * w, low + 0.22f * h}, {w, low + 0.55f * h},     {0.985f * w, low + 0.84f * h},
            {0.94f * w, top},  {0.80f * w, top + 0.025f},     {0.42f * w, top + 0.05f}, {0, top + 0.058f}};
        constexpr int last = 7;
        const float s = u * last;
        const int i = std::min(int(s), last - 1);
        const auto at = [&](int k) {  // mirrored past the middle
            return k > last ? Vec2{-points[2 * last - k].x, points[2 * last - k].y} : points[std::max(k, 0)];
        };
        return spline(i == 0 ? points[0] * 2 - points[1] : at(i - 1), at(i), at(i + 1), at(i + 2), s - float(i));
    }
    Vec3 surface(float z, float t) const {  // t from 0 (right sill) over the deck to 1 (left sill)
        const Vec2 p = section(z, t < 0.5f ? 2 * t : 2 - 2 * t);
        return {t < 0.5f ? p.x : -p.x, p.y, z};
    }

    void body() {
        // Stations lie closer at the wheel arches and the ends.
        std::vector<float> stations;
        for (int i = 0; i <= 26; ++i) stations.push_back(-front() + c_.length * float(i) / 26);
        for (const bool is_front : {true, false})
            for (int i = 0; i <= 14; ++i)
                stations.push_back(axle(is_front) - arch_radius * std::cos(pi * float(i) / 14) * 1.001f);
        for (const float d : {0.02f, 0.05f, 0.09f}) stations.insert(stations.end(), {front() - d, -front() + d});
        std::sort(stations.begin(), stations.end());
        stations.erase(std::unique(stations.begin(), stations.end(), [](float x, float y) { return y - x < 0.008f; }),
                       stations.end());
        const int rows = int(stations.size()) - 1;
        const auto station = [&](float t) {
            const float s = t * float(rows);
            const int i = std::min(int(s), rows - 1);
            return std::lerp(stations[size_t(i)], stations[size_t(i) + 1], s - float(i));
        };
        add_sheet(a_[paint_], 42, rows, [&](float s, float t) {
            const float z = station(1 - t);
            return SheetPoint{surface(z, 1 - s), {s * 3, t * 4}};
        });
        for (const bool is_front : {true, false}) {  // nose and tail
            const float z = is_front ? front() : -front();
            add_sheet(a_[paint_], 8, 20, [&](float s, float t) {
                const Vec2 p = section(z, t);
                const float x = (2 * s - 1) * p.x * (is_front ? 1.0f : -1.0f),
                            swell = 0.05f * (1 - (2 * s - 1) * (2 * s - 1)) * std::sin(pi * std::min(1.0f, 0.25f + t));
                return SheetPoint{{x, p.y, z + (is_front ? swell : -swell)}, {s, 1 - t}};
            });
        }
        add_block(a_[p_("dark")], {-0.43f * c_.width, floor_height, -front() + 0.25f},
                  {0.43f * c_.width, 0.62f, front() - 0.3f});  // wheel wells and floor
    }

    float roof(float z) const {
        const float base = 0.5f * (c_.bonnet + c_.boot) - 0.05f;
        const float rise =
            z > c_.roof_front
                ? smooth_step(
                      0, 1,
                      std::clamp((c_.cabin_front - z) / (c_.cabin_front - c_.roof_front), 0.0f, 1.0f) * 0.62f + 0.0f) *
                      1.22f
            : z < c_.roof_rear
                ? std::sin(0.5f * pi * std::clamp((z - c_.cabin_rear) / (c_.roof_rear - c_.cabin_rear), 0.0f, 1.0f))
                : 1.0f;
        const float bow = 1 - 0.03f * ((z - 0.5f * (c_.roof_front + c_.roof_rear)) / 0.6f) *
                                  ((z - 0.5f * (c_.roof_front + c_.roof_rear)) / 0.6f);
        return base + (c_.height - base) * std::min(1.0f, rise) * std::min(1.0f, std::max(bow, 0.85f));
    }
    Vec3 cabin_point(float z, float t) const {
        const float base = belt(z) - 0.03f, top = std::max(roof(z), base + 0.02f),
                    w = 0.5f * c_.width * rounding(z) * 0.93f;
        const float full = std::clamp((top - base) / (c_.height - 0.9f), 0.0f, 1.0f);
        const float in = 0.2f * full * w;  // tumblehome
        const Vec2 points[] = {{w, base},
                               {w - 0.45f * in, base + 0.5f * (top - base)},
                               {w - 0.92f * in, base + 0.9f * (top - base)},
                               {0.8f * (w - in), base + 0.985f * (top - base)},
                               {0.4f * w, top},
                               {0, top + 0.012f}};
        const float u = t < 0.5f ? 2 * t : 2 - 2 * t, s = u * 5;
        const int i = std::min(int(s), 4);
        const auto at = [&](int k) {
            return k > 5 ? Vec2{-points[10 - k].x, points[10 - k].y} : points[std::max(k, 0)];
        };
        const Vec2 p =
            spline(i == 0 ? points[0] * 2 - points[1] : at(i - 1), at(i), at(i + 1), at(i + 2), s - float(i));
        return {t < 0.5f ? p.x : -p.x, p.y, z};
    }
    /// Part of the cabin's surface, moved out by `out`.
    void cabin_part(int finish, float z0, float z1, float t0, float t1, float out, int columns, int rows) {
        add_sheet(a_[finish], columns, rows, [&](float s, float v) {
            const float z = z1 + v * (z0 - z1), t = t1 + s * (t0 - t1);
            const Vec3 p = cabin_point(z, t), along = cabin_point(z + 0.01f, t) - cabin_point(z - 0.01f, t),
                       across = cabin_point(z, t - 0.005f) - cabin_point(z, t + 0.005f);
            const Vec3 n = normalize(cross(across, along));
            return SheetPoint{p + n * (n.y * 0 + out) * (dot(n, Vec3(p.x, 0.2f, 0)) < -0.1f ? -1.0f : 1.0f), {s, v}};
        });
    }
    void cabin() {
        cabin_part(p_("dark_glass"), c_.cabin_rear, c_.cabin_front, 0, 1, 0, 30, 40);
        // Roof, pillars, and the frames of the side windows are paint on that glass.
        cabin_part(paint_, c_.roof_rear, c_.roof_front, 0.23f, 0.77f, 0.006f, 20, 12);
        const float b_pillar = 0.5f * (c_.roof_front + c_.roof_rear) + 0.05f;
        for (const bool left : {false, true}) {
            const auto side = [&](float t) { return left ? 1 - t : t; };
            const auto strip = [&](float z0, float z1, float ta, float tb, int rows) {
                cabin_part(paint_, z0, z1, std::min(side(ta), side(tb)), std::max(side(ta), side(tb)), 0.007f, 6, rows);
            };
            strip(c_.roof_rear - 0.1f, c_.roof_front + 0.12f, 0.19f, 0.27f, 14);  // rail
            strip(b_pillar - 0.045f, b_pillar + 0.045f, 0, 0.24f, 4);             // between the doors
            strip(c_.cabin_rear + 0.02f, c_.roof_rear + 0.08f, 0, 0.29f, 14);     // behind
            // The front pillar follows the windscreen's edge.
            std::vector<Vec3> edge;
            for (int i = 0; i <= 10; ++i)
                edge.push_back(
                    cabin_point(std::lerp(c_.cabin_front - 0.04f, c_.roof_front, float(i) / 10), side(0.24f)));
            add_tube(a_[paint_], edge, 0.034f, 7);
        }
    }

    void wheels() {
        for (const bool is_front : {true, false})
            for (const float side : {-1.0f, 1.0f}) {
                Assembly w;
                Shape tyre, rim;
                add_lathe(tyre,
                          {{0.21f, 0.08f},
                           {0.27f, 0.0f},
                           {0.305f, 0.012f},
                           {wheel_radius, 0.04f},
                           {wheel_radius, 0.17f},
                           {0.3f, 0.2f},
                           {0.2f, 0.2f}},
                          32, {2, 0.4f});
                add_lathe(rim,
                          {{0.001f, 0.028f},
                           {0.05f, 0.03f},
                           {0.06f, 0.045f},
                           {0.15f, 0.06f},
                           {0.185f, 0.03f},
                           {0.2f, 0.015f},
                           {0.215f, 0.02f},
                           {0.215f, 0.08f}},
                          32, {1, 0.3f});
                // A lathe is drawn from bottom to top with the outside to the right: turned over, the wheel's face is
                // below.
                const auto face = [](Shape s) {
                    for (auto& t : s.triangles) std::swap(t[1], t[2]);
                    for (Vec3& n : s.normals) n = -n;
                    return s;
                };
                append(w[p_("rubber")], tyre, {});
                append(w[p_("chrome")], face(rim), {});
                for (int i = 0; i < 5; ++i) {
                    const float phi = 2 * pi * (float(i) + 0.5f) / 5;
                    add_tube(w[p_("dark")],
                             {{0.12f * std::cos(phi), 0.046f, 0.12f * std::sin(phi)},
                              {0.12f * std::cos(phi), 0.056f, 0.12f * std::sin(phi)}},
                             0.034f, 10);
                }
                // y of the lathe becomes the way into the car.
                const Transform outwards = {{0, 0, 1},
                                            {-side, 0, 0},
                                            {0, -side, 0},
                                            {side * (0.5 * c_.width - 0.015), wheel_radius, axle(is_front)}};
                append(a_, w, outwards);
            }
    }

    /// Line on the body at height u of the section, from z0 to z1.
    void line(int finish, float t, float z0, float z1, float radius) {
        std::vector<Vec3> path;
        for (int i = 0; i <= 12; ++i) path.push_back(surface(std::lerp(z0, z1, float(i) / 12), t));
        add_tube(a_[finish], path, radius, 5);
    }

    void fittings() {
        const int dark = p_("dark"), chrome = p_("chrome");
        const float mid = 0.5f * (c_.roof_front + c_.roof_rear) + 0.05f;
        for (const bool left : {false, true}) {
            const auto side = [&](float t) { return left ? 1 - t : t; };
            for (const float z : {c_.cabin_front - 0.12f, mid, c_.cabin_rear + 0.55f}) {  // shut lines
                std::vector<Vec3> path;
                for (int i = 0; i <= 10; ++i) path.push_back(surface(z, side(0.02f + 0.25f * float(i) / 10)));
                add_tube(a_[dark], path, 0.0045f, 4);
            }
            line(dark, side(0.03f), axle(true) - 0.42f, axle(false) + 0.42f, 0.012f);
            line(chrome, side(0.285f), c_.cabin_front - 0.05f, c_.cabin_rear + 0.2f, 0.007f);
            for (const float z : {mid + 0.14f, mid - 0.78f}) {
                const Vec3 at = surface(z, side(0.235f));
                const float x = left ? -0.012f : 0.012f;
                add_tube(a_[chrome],
                         rounded({at, at + Vec3(2 * x, 0, 0.02f), at + Vec3(2 * x, 0, 0.15f), at + Vec3(0, 0, 0.17f)},
                                 0.015f),
                         0.009f, 6);
            }
            const Vec3 mirror = cabin_point(c_.cabin_front - 0.3f, side(0.05f));
            const float out = left ? -1.0f : 1.0f;
            Shape shell;
            add_lathe(shell,
                      {{0.001f, -0.09f},
                       {0.05f, -0.075f},
                       {0.075f, -0.03f},
                       {0.075f, 0.03f},
                       {0.05f, 0.075f},
                       {0.001f, 0.09f}},
                      12, {0.3f, 0.3f});
            append(a_[paint_], shell,
                   translate(Vec3d(mirror + Vec3(out * 0.13f, 0.03f, 0.02f))) * scale({1.25, 0.85, 0.75}));
            // Lamps sit in the corners.
            const Vec3 head = head_lamp(out);
            const float w = std::abs(head.x), y = head.y + 0.03f;
            Shape lens;
            add_lathe(lens, {{0.17f, 0}, {0.16f, 0.04f}, {0.1f, 0.07f}, {0.001f, lens_depth}}, 18, {1, 0.2f});
            constexpr Transform along_z = {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}, {}};
            append(a_[p_("head_lamp")], lens, translate(Vec3d(head)) * scale({1.15, 0.55, 1}) * along_z);
            if (c_.lamps_on) {
                Shape bulb;
                add_lathe(bulb, {{0.05f, 0}, {0.035f, 0.012f}, {0.001f, 0.016f}}, 12, {1, 0.2f});
                append(a_[head_lamp_glow(p_)], bulb, translate(Vec3d(head + Vec3(0, 0, lens_depth))) * along_z);
            }
            append(a_[p_("amber_lamp")], lens,
                   translate({out * (w + 0.02), y - 0.26, front() - 0.0}) * scale({0.45, 0.2, 0.6}) * along_z);
            append(a_[c_.lamps_on ? tail_lamp_glow(p_) : p_("tail_lamp")], lens,
                   translate({out * (w + 0.02), belt(-front()) - 0.1, -front() + 0.02}) * rotate_y(pi) *
                       scale({0.95, 0.7, 1}) * along_z);
        }
        const float y = belt(front());
        for (int i = 0; i < 4; ++i)  // grille
            add_box(a_[i == 0 ? chrome : dark], {-0.36f, y - 0.1f - 0.045f * float(i), front() + 0.02f},
                    {0.36f, y - 0.072f - 0.045f * float(i), front() + 0.058f}, {}, 0.006f);
        for (const float end : {1.0f, -1.0f}) {  // bumpers and plates
            const float z = end * front();
            std::vector<Vec3> bar;
            for (int i = -8; i <= 8; ++i) {
                const float s = float(i) / 8;
                bar.push_back({s * 0.5f * c_.width * 0.83f, 0.42f, z + end * (0.075f - 0.13f * s * s * s * s)});
            }
            add_tube(a_[paint_], bar, 0.065f, 8);
            for (Vec3& p : bar) p.y = 0.3f, p.z -= end * 0.03f;
            add_tube(a_[dark], bar, 0.06f, 8);
            Shape plate;
            add_box(plate, {-0.25f, 0.4f, 0.13f}, {0.25f, 0.51f, 0.145f}, {}, 0.004f);
            append(a_[p_("white_paint")], plate, translate({0, 0, z}) * rotate_y(end > 0 ? 0 : pi));
        }
        if (!c_.taxi_sign) return;
        const int sign = p_("taxi_sign", [](Scene&) {
            Material m = matte("taxi_sign", Rgb(0.8f), 0.4f);
            m.emission = nits(halogen, 350);
            m.lamp = true;
            return m;
        });
        add_box(a_[sign], {-0.24f, c_.height + 0.01f, -0.55f}, {0.24f, c_.height + 0.15f, -0.4f}, {}, 0.02f);
    }

    Palette& p_;
    int paint_;
    Assembly a_;
};

}  // namespace

CarShape saloon() {
    return {};
}
CarShape hatchback() {
    return {.length = 3.95f,
            .width = 1.72f,
            .height = 1.47f,
            .bonnet = 0.95f,
            .boot = 1.0f,
            .cabin_front = 0.82f,
            .cabin_rear = -1.85f,
            .roof_front = 0.1f,
            .roof_rear = -1.4f};
}
CarShape estate() {
    return {.length = 4.7f,
            .width = 1.84f,
            .height = 1.66f,
            .bonnet = 1.02f,
            .boot = 1.08f,
            .cabin_front = 0.85f,
            .cabin_rear = -2.25f,
            .roof_front = 0.12f,
            .roof_rear = -1.9f};
}

Assembly car(Palette& palette, const CarShape& shape, const std::string& paint) {
    return CarBuilder(palette, shape, paint).build();
}

}  // namespace pluvia
