// What fills the bays of a house's front: boards, plaster, lattices, doors and windows.
// lane_house.cpp builds the frame around them; the letters are explained in lane.h.
#include "scenes/lane_bays.h"

#include "renderer/core/units.h"

#include <algorithm>
#include <cmath>

namespace pluvia::lane {
namespace {

void rail(const BayWork& work, const Bay& bay, float bottom, float top, float front = post_front) {
    add_box(work.assembly[work.posts], {bay.left, bottom, recess}, {bay.right, top, front}, work.chance.tint(0.25f));
}

void plaster_panel(const BayWork& work, const Bay& bay) {
    const Vec3 p = {bay.left, bay.bottom, -0.03f};
    const float w = bay.width(), h = bay.top - bay.bottom;
    if (h <= 0) return;
    add_quad(work.assembly[work.walls], {p, p + Vec3(w, 0, 0), p + Vec3(w, h, 0), p + Vec3(0, h, 0)}, {p.x, -p.y},
             {p.x + w, -p.y - h}, {Rgb(1), {work.chance(0, 2), work.chance(0, 2)}});
}

/// The whole picture of a finish, stretched over the opening.
void picture(const BayWork& work, const Bay& bay, float z, int finish) {
    add_quad(
        work.assembly[finish],
        {Vec3{bay.left, bay.bottom, z}, {bay.right, bay.bottom, z}, {bay.right, bay.top, z}, {bay.left, bay.top, z}},
        {0, 1}, {1, 0});
}

void boards(const BayWork& work, const Bay& bay) {
    const int count = std::max(1, int(std::round(bay.width() / 0.15f)));
    const float pitch = bay.width() / float(count);
    for (int i = 0; i < count; ++i) {
        const float x = bay.left + pitch * float(i), front = -0.03f + work.chance(-0.006f, 0.006f);
        add_plank(work.assembly[work.boards], {x + 0.002f, bay.bottom, front - 0.02f},
                  {x + pitch - 0.002f, bay.top, front}, 0.006f, work.chance.tint(0.4f));
    }
    if (bay.top - bay.bottom > 1)  // battens over every second joint
        for (int i = 2; i < count; i += 2) {
            const float x = bay.left + pitch * float(i);
            add_box(work.assembly[work.boards], {x - 0.014f, bay.bottom, -0.04f}, {x + 0.014f, bay.top, -0.006f},
                    work.chance.tint(0.4f));
        }
}

void weatherboards(const BayWork& work, const Bay& bay) {
    const float dado = bay.bottom + 0.85f;
    plaster_panel(work, {bay.left, bay.right, dado, bay.top});
    const int count = 5;
    for (int i = 0; i < count; ++i) {
        const float y = bay.bottom + (dado - bay.bottom) * float(i) / count, h = (dado - bay.bottom) / count;
        Shape board;
        add_box(board, {bay.left, 0, -0.01f}, {bay.right, h * 1.15f, 0.008f}, work.chance.tint(0.4f));
        append(work.assembly[work.boards], board,
               translate({0, y, -0.03}) * rotate(std::sin(-0.06), 0, 0, std::cos(-0.06)));
    }
    for (float x = bay.left + 0.12f; x < bay.right - 0.06f; x += 0.32f)
        add_box(work.assembly[work.boards], {x, bay.bottom, -0.05f}, {x + 0.03f, dado, 0.012f}, work.chance.tint(0.4f));
    rail(work, bay, dado, dado + 0.05f, 0.03f);
}

void corrugated(const BayWork& work, const Bay& bay) {
    constexpr float wave = 0.076f;
    const int columns = int(bay.width() / wave * 8);
    add_sheet(
        work.assembly[work.finishes.zinc], columns, 2,
        [&](float s, float t) {
            const float x = bay.left + s * bay.width(), y = bay.bottom + t * (bay.top - bay.bottom);
            return SheetPoint{{x, y, -0.035f + 0.009f * std::sin(2 * pi * x / wave)}, {x, -y}};
        },
        work.chance.tint(0.15f));
}

/// Upright bars before lit paper (or darkness, finish -1).
void lattice(const BayWork& work, const Bay& bay, int finish, float pitch) {
    picture(work, bay, -0.115f, finish < 0 ? work.finishes.glass : finish);
    const int count = std::max(2, int(bay.width() / pitch));
    for (int i = 1; i < count; ++i) {
        const float x = bay.left + bay.width() * float(i) / float(count);
        add_box(work.assembly[work.posts], {x - 0.011f, bay.bottom, -0.07f}, {x + 0.011f, bay.top, -0.025f},
                work.chance.tint(0.3f));
    }
    for (int i = 1; i <= 3; ++i) {
        const float y = bay.bottom + (bay.top - bay.bottom) * float(i) / 4;
        add_box(work.assembly[work.posts], {bay.left, y - 0.012f, -0.085f}, {bay.right, y + 0.012f, -0.05f},
                work.chance.tint(0.3f));
    }
}

void sliding_door(const BayWork& work, const Bay& bay) {
    picture(work, bay, -0.12f, work.finishes.lit_window);
    const float middle = 0.5f * (bay.left + bay.right);
    for (const bool second : {false, true}) {  // two leaves, one before the other
        const float left = second ? middle - 0.03f : bay.left, right = second ? bay.right : middle + 0.03f;
        const float z = second ? -0.095f : -0.06f;
        const auto bar = [&](float x0, float y0, float x1, float y1) {
            add_box(work.assembly[work.posts], {x0, y0, z - 0.03f}, {x1, y1, z}, work.chance.tint(0.25f));
        };
        bar(left, bay.bottom, left + 0.05f, bay.top);
        bar(right - 0.05f, bay.bottom, right, bay.top);
        bar(left, bay.top - 0.06f, right, bay.top);
        bar(left, bay.bottom, right, bay.bottom + 0.4f);
        for (int i = 1; i <= 5; ++i) {
            const float y = bay.bottom + 0.4f + (bay.top - bay.bottom - 0.46f) * float(i) / 6;
            bar(left, y - 0.009f, right, y + 0.009f);
        }
        for (int i = 1; i <= 3; ++i) {
            const float x = left + (right - left) * float(i) / 4;
            bar(x - 0.009f, bay.bottom + 0.4f, x + 0.009f, bay.top);
        }
    }
}

void slits(const BayWork& work, const Bay& bay) {
    picture(work, bay, -0.13f, work.finishes.warm_window);
    const int count = std::max(3, int(bay.width() / 0.1f));
    for (int i = 0; i < count; ++i) {
        const float x = bay.left + bay.width() * (float(i) + 0.5f) / float(count);
        add_box(work.assembly[work.walls], {x - 0.027f, bay.bottom, -0.1f}, {x + 0.027f, bay.top, -0.02f},
                work.chance.tint(0.1f), 0.012f);
    }
}

void blind(const BayWork& work, const Bay& bay) {
    picture(work, bay, -0.12f, work.finishes.warm_window);
    const float hem = bay.bottom - 0.1f, roll = 0.05f;
    int row = 0;
    for (float y = bay.top - roll; y > hem; y -= 0.018f, ++row)  // reeds
        add_box(work.assembly[work.finishes.bamboo], {bay.left, y - 0.0135f, 0.05f}, {bay.right, y, 0.058f},
                work.chance.tint(0.5f));
    add_tube(work.assembly[work.finishes.bamboo], {{bay.left - 0.02f, hem, 0.055f}, {bay.right + 0.02f, hem, 0.055f}},
             0.014f, 8);
    for (const float x : {bay.left + 0.12f, bay.right - 0.12f})
        add_box(work.assembly[work.finishes.indigo_cloth], {x - 0.006f, hem, 0.058f}, {x + 0.006f, bay.top, 0.062f});
}

void pane(const BayWork& work, const Bay& bay) {
    picture(work, bay, -0.1f, work.finishes.glass);
    const float middle = 0.5f * (bay.left + bay.right);
    for (const float x : {bay.left + 0.02f, middle, bay.right - 0.02f})
        add_box(work.assembly[work.posts], {x - 0.02f, bay.bottom, -0.1f}, {x + 0.02f, bay.top, -0.04f},
                work.chance.tint(0.25f));
    for (int i = 0; i <= 4; ++i) {  // railing
        const float y = bay.bottom + 0.08f + 0.09f * float(i);
        add_box(work.assembly[work.posts], {bay.left - 0.03f, y, 0.05f}, {bay.right + 0.03f, y + 0.02f, 0.075f},
                work.chance.tint(0.3f));
    }
    for (const float x : {bay.left, bay.right})
        add_box(work.assembly[work.posts], {x - 0.02f, bay.bottom - 0.05f, post_front},
                {x + 0.02f, bay.bottom + 0.5f, 0.08f});
}

}  // namespace

void fill_ground_bay(const BayWork& work, char letter, const Bay& bay) {
    const Bay above = {bay.left, bay.right, lintel_height, bay.top};
    Bay below = {bay.left, bay.right, bay.bottom, lintel_height};
    if (letter == 'B') return boards(work, bay);
    if (letter == 'g') return corrugated(work, bay);
    rail(work, bay, lintel_height - 0.05f, lintel_height + 0.05f);
    plaster_panel(work, above);
    switch (letter) {
        case 'b':
            return boards(work, below);
        case 's':
            return weatherboards(work, below);
        case 'l':
        case 'k': {
            const float sill = 0.78f;
            boards(work, {below.left, below.right, below.bottom, sill});
            rail(work, bay, sill, sill + 0.07f, 0.05f);
            return lattice(work, {below.left, below.right, sill + 0.07f, below.top - 0.05f},
                           letter == 'l' ? work.finishes.lit_window : -1, 0.058f);
        }
        case 'd':
            return sliding_door(work, below);
        default: {
            sliding_door(work, below);
            Assembly curtain = noren(work.finishes, below.width() - 0.06f, 0.62f);
            for (const auto& [finish, shape] : curtain.shapes)
                append(work.assembly[finish], shape,
                       translate({0.5 * (below.left + below.right), below.top - 0.02, 0.075}));
        }
    }
}

void fill_upper_bay(const BayWork& work, char letter, const Bay& bay) {
    const float sill = bay.bottom + 0.42f * (bay.top - bay.bottom) - 0.2f, head = bay.top - 0.28f;
    const Bay window = {bay.left + 0.03f, bay.right - 0.03f, sill, head};
    if (letter == 'b') return boards(work, bay);
    if (letter == 'p') return plaster_panel(work, bay);
    plaster_panel(work, {bay.left, bay.right, bay.bottom, sill});
    plaster_panel(work, {bay.left, bay.right, head, bay.top});
    rail(work, bay, sill - 0.06f, sill, 0.06f);
    rail(work, bay, head, head + 0.05f, 0.03f);
    switch (letter) {
        case 'w':
            return lattice(work, window, work.finishes.warm_window, 0.09f);
        case 'm':
            return slits(work, window);
        case 's':
            return blind(work, window);
        default:
            return pane(work, window);
    }
}

}  // namespace pluvia::lane
