// What drops show in front of a picture, by their place in the view: light from all around at a few thousand places,
// computed once and shared by all pixels and samples. Quick and almost without noise for rain that is too fine to show
// where it is, but BIASED: between the places it is interpolated, so that the halo of a lamp is as wide as a cell at
// least.
#pragma once

#include "renderer/core/view.h"
#include "renderer/transport/far_light.h"
#include "renderer/transport/path.h"
#include "renderer/transport/picture_source.h"

#include <array>
#include <vector>

namespace pluvia {

class DropLight {
public:
    /// Layers of the view depth, each half as deep again as all before it; the last one reaches to infinity.
    static constexpr int slices = 18;
    /// Where the light of a cell comes from, as this many directions of equal share.
    static constexpr int directions = 4;

    /// Light of lamps and of the surfaces that the tracer's scene has; what is farther is far's. near: metres of view
    /// depth where rain begins.
    DropLight(const PathTracer& tracer, const FarLight& far, const PictureSource& picture, const View& view,
              uint64_t seed, float near = 0.1f);

    static int slice_of(float z);
    /// View depth at which a slice ends, metres.
    static float end_of(int slice);

    /// Radiance of drops towards the camera in the slices up to `last`, for a pixel.
    void find(int x, int y, int last, std::array<Rgb, slices>& light) const;
    /// From where a drop in a slice is lit: one of its directions. u: uniform in [0, 1).
    Vec3 direction(int x, int y, int slice, float u) const;

private:
    struct Cell {
        std::array<Rgb, slices> light;
        std::array<std::array<Vec3, directions>, slices> from;
    };
    Cell estimate(const PathTracer& tracer, const FarLight& far, const PictureSource& picture, const View& view,
                  uint64_t seed, float near, int column, int row) const;
    const Cell& cell(int column, int row) const { return cells_[size_t(row) * size_t(columns_) + size_t(column)]; }

    int size_, columns_, rows_;  // pixels; cells
    std::vector<Cell> cells_;
};

}  // namespace pluvia
