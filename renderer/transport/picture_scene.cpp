#include "renderer/transport/picture_scene.h"

#include "renderer/core/units.h"

#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace pluvia {
namespace {

/// The picture in square blocks of pixels, smaller ones at its right and lower edge.
struct Blocks {
    int size, columns, rows;
    std::vector<Rgb> mean;

    Rgb& at(int column, int row) { return mean[size_t(row) * columns + column]; }
    const Rgb& at(int column, int row) const { return mean[size_t(row) * columns + column]; }
};

Blocks find_blocks(const Image<Rgb>& image, int columns_wanted) {
    Blocks blocks;
    blocks.size = std::max(1, (image.width + columns_wanted - 1) / columns_wanted);
    blocks.columns = (image.width + blocks.size - 1) / blocks.size;
    blocks.rows = (image.height + blocks.size - 1) / blocks.size;
    blocks.mean.resize(size_t(blocks.columns) * blocks.rows);
    for (int row = 0; row < blocks.rows; ++row)
        for (int column = 0; column < blocks.columns; ++column) {
            double r = 0, g = 0, b = 0;
            const int x1 = std::min(image.width, (column + 1) * blocks.size);
            const int y1 = std::min(image.height, (row + 1) * blocks.size);
            for (int y = row * blocks.size; y < y1; ++y)
                for (int x = column * blocks.size; x < x1; ++x) {
                    const Rgb c = image.at(x, y);
                    r += c.r, g += c.g, b += c.b;
                }
            const double n = double(x1 - column * blocks.size) * (y1 - row * blocks.size);
            blocks.at(column, row) = Rgb(float(r / n), float(g / n), float(b / n));
        }
    return blocks;
}

float mean_luminance(const Blocks& blocks) {
    double sum = 0;
    for (const Rgb c : blocks.mean) sum += luminance(c);
    return float(sum / double(blocks.mean.size()));
}

/// Positions at the corners of the blocks, NaN in the sky.
class Corners {
public:
    Corners(const PictureSource& picture, const View& view, const Blocks& blocks)
        : columns_(blocks.columns + 1), points_(size_t(columns_) * (blocks.rows + 1)), depths_(points_.size()) {
        for (int row = 0; row <= blocks.rows; ++row)
            for (int column = 0; column < columns_; ++column) {
                const int x = std::min(column * blocks.size, view.width);
                const int y = std::min(row * blocks.size, view.height);
                const float z = picture.z.at(std::min(x, view.width - 1), std::min(y, view.height - 1));
                const Vec3 seen = view.view_direction({float(x), float(y)}) * z;
                const size_t i = size_t(row) * columns_ + column;
                depths_[i] = z;
                if (std::isfinite(z)) points_[i] = Vec3(view.world_vector_from_view(Vec3d(seen)));
            }
    }

    std::array<uint32_t, 4> of_block(int column, int row) const {
        const auto i = uint32_t(row) * uint32_t(columns_) + uint32_t(column), below = i + uint32_t(columns_);
        return {i, i + 1, below, below + 1};
    }
    bool is_surface(uint32_t a, uint32_t b, uint32_t c, float largest_step) const {
        const auto [least, most] = std::minmax({depths_[a], depths_[b], depths_[c]});
        return std::isfinite(most) && most <= largest_step * least;
    }
    Vec3 point(uint32_t i) const { return points_[i]; }

private:
    int columns_;
    std::vector<Vec3> points_;  // from the camera
    std::vector<float> depths_;
};

/// A mesh with the corners of some blocks, each block's own so that it keeps its colour.
void add_block(Mesh& mesh, const Corners& corners, int column, int row, float largest_step, const Rgb* color) {
    const auto c = corners.of_block(column, row);
    // Split along the diagonal that leaves the smaller gap where a corner is sky or another object.
    const bool falling =
        corners.is_surface(c[0], c[2], c[3], largest_step) || corners.is_surface(c[0], c[3], c[1], largest_step);
    const std::array<std::array<int, 3>, 2> halves = falling
                                                         ? std::array<std::array<int, 3>, 2>{{{0, 2, 3}, {0, 3, 1}}}
                                                         : std::array<std::array<int, 3>, 2>{{{0, 2, 1}, {1, 2, 3}}};
    const auto first = uint32_t(mesh.positions.size());
    bool any = false;
    for (const auto& half : halves) {
        if (!corners.is_surface(c[size_t(half[0])], c[size_t(half[1])], c[size_t(half[2])], largest_step)) continue;
        mesh.triangles.push_back({first + uint32_t(half[0]), first + uint32_t(half[1]), first + uint32_t(half[2])});
        any = true;
    }
    if (!any) return;
    for (const uint32_t i : c) {
        mesh.positions.push_back(corners.point(i));
        if (color) mesh.colors.push_back(*color);
    }
}

void add_instance(Scene& scene, Mesh mesh, const Material& material, const View& view) {
    if (mesh.triangles.empty()) return;
    mesh.material = int(scene.materials.size());
    scene.materials.push_back(material);
    scene.instances.push_back({.name = mesh.name,
                               .id = instance_id(mesh.name),
                               .mesh = int(scene.meshes.size()),
                               .scene_from_object = translate(view.position)});
    scene.meshes.push_back(std::move(mesh));
}

/// For each block the number of its lamp, the first block of a connected bright region, or -1.
std::vector<int> find_lamps(const Blocks& blocks, float threshold) {
    std::vector<int> lamp(blocks.mean.size(), -1), open;
    for (int start = 0; start < int(lamp.size()); ++start) {
        if (lamp[size_t(start)] >= 0 || !(luminance(blocks.mean[size_t(start)]) > threshold)) continue;
        lamp[size_t(start)] = start;
        open.push_back(start);
        while (!open.empty()) {
            const int i = open.back(), x = i % blocks.columns, y = i / blocks.columns;
            open.pop_back();
            for (const auto& [dx, dy] : {std::pair(-1, 0), {1, 0}, {0, -1}, {0, 1}}) {
                if (x + dx < 0 || x + dx >= blocks.columns || y + dy < 0 || y + dy >= blocks.rows) continue;
                const int next = i + dx + dy * blocks.columns;
                if (lamp[size_t(next)] >= 0 || !(luminance(blocks.mean[size_t(next)]) > threshold)) continue;
                lamp[size_t(next)] = start;
                open.push_back(next);
            }
        }
    }
    return lamp;
}

/// Whether the middle of a block is sky.
bool is_sky(const PictureSource& picture, const Blocks& blocks, int column, int row) {
    const int x = std::min(picture.z.width - 1, column * blocks.size + blocks.size / 2);
    const int y = std::min(picture.z.height - 1, row * blocks.size + blocks.size / 2);
    return !std::isfinite(picture.z.at(x, y));
}

/// Light of a block for the environment: lamps are lights of their own, so they are as bright as what is no lamp.
Rgb without_lamp(Rgb color, float limit) {
    const float y = luminance(color);
    return y > limit ? color * (limit / y) : color;
}

}  // namespace

Scene make_picture_scene(const PictureSource& picture, const View& view, const PictureSceneSettings& settings) {
    const Blocks blocks = find_blocks(picture.radiance, settings.columns);
    const Corners corners(picture, view, blocks);
    float brightest = 0;
    for (const Rgb c : blocks.mean) brightest = std::max(brightest, max_component(c));
    Scene scene;
    scene.name = "picture";
    scene.unlit_luminance = brightest > 0 ? brightest : 1;

    const std::vector<int> lamp = find_lamps(blocks, settings.lamp_contrast * mean_luminance(blocks));
    Mesh surfaces;
    surfaces.name = "surfaces";
    std::map<int, std::vector<int>> lamps;  // blocks of each
    for (int row = 0; row < blocks.rows; ++row)
        for (int column = 0; column < blocks.columns; ++column) {
            const int i = row * blocks.columns + column;
            if (lamp[size_t(i)] >= 0) {
                lamps[lamp[size_t(i)]].push_back(i);
                continue;
            }
            const Rgb color = blocks.at(column, row) * (1 / scene.unlit_luminance);
            add_block(surfaces, corners, column, row, settings.largest_step, &color);
        }
    Material unlit;
    unlit.name = "surfaces";
    unlit.unlit = true;
    add_instance(scene, std::move(surfaces), unlit, view);
    for (const auto& [number, members] : lamps) {
        Mesh mesh;
        mesh.name = "lamp " + std::to_string(number);
        Material material;
        material.name = mesh.name;
        material.base_color = Rgb(0), material.metallic = 0, material.specular = 0;
        material.double_sided = true;
        for (const int i : members) {
            add_block(mesh, corners, i % blocks.columns, i / blocks.columns, settings.largest_step, nullptr);
            material.emission += blocks.mean[size_t(i)] * (1 / float(members.size()));
        }
        add_instance(scene, std::move(mesh), material, view);
    }
    return scene;
}

Environment estimate_environment(const PictureSource& picture, const View& view, const PictureSceneSettings& settings) {
    constexpr int width = 256, height = 128, coarse = 128;
    Blocks blocks = find_blocks(picture.radiance, coarse);
    const float limit = settings.lamp_contrast * mean_luminance(blocks);
    for (int row = 0; row < blocks.rows; ++row)
        for (int column = 0; column < blocks.columns; ++column)
            if (!is_sky(picture, blocks, column, row))
                blocks.at(column, row) = without_lamp(blocks.at(column, row), limit / settings.lamp_contrast);
    const auto row_mean = [&](int row) {
        Rgb sum;
        for (int column = 0; column < blocks.columns; ++column) sum += blocks.at(column, row);
        return sum / float(blocks.columns);
    };
    const Rgb top = row_mean(0), bottom = row_mean(blocks.rows - 1);

    // Azimuth and elevation in the camera's frame, 0 on its axis.
    const Vec3 upper_left = view.view_direction({0, 0});
    const Vec3 lower_right = view.view_direction({float(view.width), float(view.height)});
    const float left = std::atan(upper_left.x), right = std::atan(lower_right.x);
    const float up = std::atan(upper_left.y), down = std::atan(lower_right.y);
    Image<Rgb> sky(width, height);
    for (int v = 0; v < height; ++v)
        for (int u = 0; u < width; ++u) {
            const Vec3d world(direction_from_equirectangular((u + 0.5) / width, (v + 0.5) / height));
            const Vec3d d = view.view_from_world(view.position + world);
            const float across = std::clamp(float(std::atan2(d.x, std::abs(d.z))), left, right);
            const float above = std::asin(std::clamp(float(d.y), -1.0f, 1.0f));
            const float tangent = std::tan(std::clamp(above, down, up));
            // A row of the picture has the elevation `tangent` where it crosses the axis.
            const Vec2 pixel = view.pixel_from_view({std::tan(across), tangent, 1});
            const int column = std::clamp(int(pixel.x) / blocks.size, 0, blocks.columns - 1);
            const int row = std::clamp(int(pixel.y) / blocks.size, 0, blocks.rows - 1);
            Rgb color = blocks.at(column, row);
            if (above > up) color = mix(color, top, std::min(1.0f, (above - up) / (pi / 2 - up)));
            if (above < down) color = mix(color, bottom, std::min(1.0f, (down - above) / (pi / 2 + down)));
            sky.at(u, v) = color;
        }
    return Environment(std::move(sky));
}

FarLight make_far_light(const PictureSource& picture, const View& view, const Environment& environment,
                        const PictureSceneSettings& settings) {
    const Environment estimated = estimate_environment(picture, view, settings);
    const auto radiance = [&](Vec3 direction) {
        const Vec3 seen = Vec3(view.view_from_world(view.position + Vec3d(direction)));
        if (seen.z <= 0) return environment.radiance(direction);
        const Vec2 pixel = view.pixel_from_view(seen);
        const bool inside = pixel.x >= 0 && pixel.y >= 0 && pixel.x < float(view.width) && pixel.y < float(view.height);
        const bool surface = inside && std::isfinite(picture.z.at(int(pixel.x), int(pixel.y)));
        return surface ? estimated.radiance(direction) : environment.radiance(direction);
    };
    return FarLight(radiance, [&](Vec3 direction) { return environment.radiance(direction); });
}

}  // namespace pluvia
