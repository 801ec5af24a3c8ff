// Light of drops by their place in the view, for rain that is too fine to show where it is: a few thousand places,
// computed once and shared by all pixels and samples. Quick and almost without noise, but BIASED: between the places it
// is interpolated, so that no beam of light is narrower than a cell. Made by picture_drop_light.h, scene_drop_light.h.
#pragma once

#include "renderer/core/counters.h"
#include "renderer/core/rgb.h"
#include "renderer/core/vec.h"
#include "renderer/core/view.h"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace pluvia {

class DropLightSamples;

class DropLight {
public:
    /// Layers of the view depth, each half as deep again as all before it; the last one reaches to infinity.
    static constexpr int slices = 18;
    /// Where the light of a cell comes from, as this many directions of equal share.
    static constexpr int directions = 4;

    /// Of drops towards the camera.
    struct Light {
        Rgb radiance;     // cd/m2
        float lamps = 0;  // luminance that lamps bring straight if nothing shadows them, where radiance lacks it, cd/m2
    };
    using Slices = std::array<Light, slices>;

    /// The pixels of a cell.
    struct Area {
        int column, row;  // of the cell
        int x, y, width, height;

        Vec2 at(Vec2 u) const { return {float(x) + u.x * float(width), float(y) + u.y * float(height)}; }
        Vec2 middle() const { return at({0.5f, 0.5f}); }
    };
    /// May be called from any thread.
    using Estimate = std::function<DropLightSamples(const Area&, Counters&)>;

    /// Of cells at least least_size pixels wide, of which there are at most 64 side by side. smooth: each lends half of
    /// its samples to those around it and to the slices beside, by the weights 1, 2, 1.
    DropLight(const View& view, int least_size, bool smooth, const Estimate& estimate, Counters& counters);

    static int slice_of(float z);
    /// View depth at which a slice ends, metres.
    static float end_of(int slice);
    /// A view depth in a slice, before a surface at `deepest` and not before `near`, at a share u of the way. In the
    /// last slice, where all is far away, its begin.
    static float depth_in(int slice, float near, float deepest, float u);

    /// Light of drops in the slices up to `last`, for a pixel: between the middles of cells, of those that know it.
    void find(int x, int y, int last, Slices& light) const;
    /// From where a drop in a slice is lit: one of its directions. u: uniform in [0, 1).
    Vec3 direction(int x, int y, int slice, float u) const;

private:
    struct Cell {
        Slices light;
        std::array<float, slices> known;  // 0 to 1: share of the cell in which the slice lies before the surface
        std::array<std::array<Vec3, directions>, slices> from;
    };
    static Cell mean(const DropLightSamples& samples);
    const Cell& cell(int column, int row) const { return cells_[size_t(row) * size_t(columns_) + size_t(column)]; }

    int size_, columns_, rows_;  // pixels; cells
    std::vector<Cell> cells_;
};

/// What is found for a cell.
class DropLightSamples {
public:
    /// base: light of all slices, to which the samples add. ahead: where light comes from in slices in which no
    /// direction is offered.
    DropLightSamples(Rgb base, Vec3 ahead) : base_(base), ahead_(ahead) {}

    /// Light that is not finite is counted as invalid.
    void add(int slice, const DropLight::Light& light, Counters& counters);
    /// A direction that light comes from, with a weight in proportion to that light. key: of random numbers.
    void offer(int slice, Vec3 direction, float weight, uint64_t key);

private:
    friend class DropLight;
    struct Sum {
        std::array<double, 5> light_and_count = {};  // r, g, b, lamps

        double count() const { return light_and_count[4]; }
        /// This, in the middle, and those before and after it.
        Sum smoothed(const Sum& before, const Sum& after) const;
    };
    struct Directions {
        float offered = 0;
        std::array<Vec3, DropLight::directions> chosen = {};
    };
    static void smooth(std::vector<DropLightSamples>& cells, int columns);

    Rgb base_;
    Vec3 ahead_;
    std::array<Sum, DropLight::slices> sums_;
    std::array<Directions, DropLight::slices> from_;
};

}  // namespace pluvia
