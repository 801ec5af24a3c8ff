// All raindrops of the world as a pure function of seed, place and time: no state, no simulation. The drops that one
// camera sees are picked by streaks.h.
//
// Drops are generated in cubic cells. Every octave of diameter has a lattice of its own, so that a search for large far
// drops never meets the many small ones. The lattice moves with the wind and the mean fall speed of its octave; a drop
// drifts within its cell by the rest of its own speed, modulo the cell's edge. So at any time the drops are exactly a
// Poisson process, uniform in space, and each follows its fall except for a rare jump by one edge.
//
// Intensities are nested: a drop carries the intensity from which on it exists. Cells are filled band by band of
// intensity, and band k holds the drops that N_k(D) has more than N_(k-1)(D); so every intensity alone has exactly the
// Marshall-Palmer distribution, and its drops do not depend on which other intensities are asked for.
#pragma once

#include "renderer/core/vec.h"
#include "renderer/rain/drop_size.h"

#include <array>
#include <cstdint>
#include <functional>

namespace pluvia {

constexpr double rain_height = 1000;  // metres above the lowest ground within which there are drops

/// Diameters d1 <= D <= d2 (metres) that share a lattice. The edges keep the drops that jump within 1/60 s to about
/// half a percent.
struct SizeClass {
    double d1, d2;
    double cell_edge;  // metres
};
constexpr std::array<SizeClass, 6> size_classes = {{{0.1e-3, 0.2e-3, 0.4},
                                                    {0.2e-3, 0.4e-3, 0.6},
                                                    {0.4e-3, 0.8e-3, 1.0},
                                                    {0.8e-3, 1.6e-3, 1.5},
                                                    {1.6e-3, 3.2e-3, 2.0},
                                                    {3.2e-3, 6.0e-3, 3.0}}};

struct DropPopulation {
    uint64_t seed = 0;
    Vec3d wind;                // m/s, world
    double lowest_ground = 0;  // metres, world y: drops exist from here to rain_height above
    Vec3d blown = {};          // metres that the air has moved beyond wind * time: winds before were others
};

struct Drop {
    Vec3d position;            // world, at the time asked for
    double diameter;           // metres
    float threshold_mm_per_h;  // it rains this drop at every intensity >= this
    uint64_t key;              // the same at all times
};

/// Velocity of a drop in the world, m/s.
inline Vec3d drop_velocity(const DropPopulation& population, double diameter) {
    return population.wind - Vec3d(0, fall_speed(diameter), 0);
}

/// Index of a cell within the lattice of its size class; it moves along with the cell.
struct CellIndex {
    int64_t x = 0, y = 0, z = 0;
};

/// Where the cells of one size class are at one time.
struct Lattice {
    double edge;      // metres
    CellIndex whole;  // displacement since time 0 in whole cells: kept apart, so that near the world's
    Vec3d remainder;  // origin no digits are lost after days of sequence time; 0 <= remainder < edge

    /// Lower corner in the world.
    Vec3d corner(CellIndex cell) const {
        return Vec3d(double(cell.x + whole.x), double(cell.y + whole.y), double(cell.z + whole.z)) * edge + remainder;
    }
    CellIndex cell_at(Vec3d point) const {
        const Vec3d p = (point - remainder) / edge;
        return {int64_t(std::floor(p.x)) - whole.x, int64_t(std::floor(p.y)) - whole.y,
                int64_t(std::floor(p.z)) - whole.z};
    }
};
Lattice lattice_at(const DropPopulation& population, int size_class, double time);

/// Calls visit, in a fixed order, for each drop in the cell at this time (seconds of the sequence) that exists at
/// max_intensity_mm_per_h and is not smaller than least_diameter. That is asked first, before costly properties are
/// drawn: it gets the lower end of the vertical line, one cell edge long, on which the drop is, and returns an infinite
/// diameter where no drop is of interest. The intensity has passed check_intensity.
void visit_drops(const DropPopulation& population, int size_class, CellIndex cell, double time,
                 double max_intensity_mm_per_h, const std::function<double(Vec3d lower_end)>& least_diameter,
                 const std::function<void(const Drop&)>& visit);

}  // namespace pluvia
