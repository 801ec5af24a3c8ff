// Environment: the light that arrives from infinitely far, as a picture of all directions and the discs of sun and moon
// apart from it. Pictures are made by sky.h or read from a file by renderer/image/image_io.h.
#pragma once

#include "renderer/core/rgb.h"
#include "renderer/core/sampling.h"
#include "renderer/core/transform.h"
#include "renderer/core/vec.h"
#include "renderer/image/image.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace pluvia {

// Compass: north is -Z, east +X, south +Z, west -X, up +Y; azimuths run clockwise from north seen from above. Picture:
// equirectangular, u to the right and v down in [0, 1]: u = 1/4 + azimuth / 360 degrees (mod 1) and v = 1/2 - elevation
// / 180 degrees. So the centre of a picture is east, and north a quarter from its left edge. It is the map of Cycles'
// environment texture, u = 1/2 - atan2(y, x) / (2 pi), behind Blender's glTF import, whose (x, y, z) is (x, -z, y)
// here: a file gives the same light in both, but for half a texel at a pole, where Cycles mixes in texels of the other
// pole.

/// Unit vector towards an azimuth and an elevation, both in radians.
Vec3d direction_from_azimuth(double azimuth, double elevation);

/// Unit direction at a position (u, v) in an equirectangular picture.
Vec3 direction_from_equirectangular(double u, double v);

/// Position (u, v) in an equirectangular picture of a unit direction. u in [0, 1], where 0 and 1 are the same place; at
/// the zenith (v = 0) and the nadir (v = 1) u is arbitrary.
Vec2 equirectangular_from_direction(Vec3 direction);

/// A round light, sampled on its own: the sun or the moon. All strips black: there is none.
struct Disc {
    Vec3 direction = {0, 1, 0};        // unit, towards the centre
    float angular_radius = 0.004651f;  // radians, above 0; 0.2665 degrees is the
                                       // sun at its mean distance
    /// Mean radiance in horizontal strips of equal height, from the lowest, in cd/m2. Near the horizon air makes the
    /// lower ones darker, and the ground hides some.
    std::vector<Rgb> strips = {Rgb(0)};
    /// Darkening u towards the limb, 1 - u (1 - c) with c = sqrt(1 - x^2) at x radii from the centre, scaled to keep
    /// the mean. The sun's is about 0.6 in visible light.
    float limb_darkening = 0;
    /// Unit vector from the disc's body to what lights it, for the phases of the moon; zero: all of it shines.
    Vec3 lit_from = {0, 0, 0};

    /// 1 - cos(angular_radius) without cancellation.
    float one_minus_cos() const;
    float solid_angle() const { return 2 * pi * one_minus_cos(); }
    /// Radiance in a unit direction, black outside.
    Rgb radiance(Vec3 towards) const;
    /// Mean over the solid angle, by quadrature within 1e-3.
    Rgb mean_radiance() const;
};

struct EnvironmentSample {
    Vec3 wi;        // unit, towards the light
    Rgb radiance;   // from there, picture and discs together
    float pdf = 0;  // solid angle, of all strategies together; 0: nothing was
                    // found, radiance is black as well
    int block = 0;  // of the picture, see Environment::block_count
};

/// Does not change while light is traced; everything const may be called from any thread.
class Environment {
public:
    /// Black.
    Environment() = default;
    /// The same radiance from everywhere, in cd/m2.
    static Environment uniform(Rgb radiance);
    /// picture: in cd/m2, linear Rec.709, looked up bilinearly: it wraps in azimuth, and beyond the centres of the
    /// first and last row it holds their value. Negative components, as resampling leaves them in files, become 0.
    /// Throws input_error when the picture has no texels or one that is not finite, or a disc no size. The tables for
    /// sampling take up to 12 bytes a texel beside the 12 of the picture: 0.8 GB for 8192 x 4096 texels.
    explicit Environment(Image<Rgb> picture, const std::vector<Disc>& discs = {});

    /// Multiplies all radiance by a factor that is finite and not negative: to apply a scale, or to reach a wanted
    /// illuminance E with E / horizontal_illuminance().
    void multiply(float factor);

    /// True when no light comes from anywhere; sample() then finds nothing.
    bool is_black() const { return luminance(mean_radiance_) == 0; }
    /// Radiance seen in a unit direction, in cd/m2: picture, and a disc where it is.
    Rgb radiance(Vec3 direction) const;

    /// Picks a disc or the picture by their illuminance on a sphere, each with 1/20 at least, then a direction: uniform
    /// in the disc, or a cell of the picture by its part of that illuminance and uniform in solid angle within the
    /// cell. Cells are squares of texels, as large as the picture is smooth. A texel counts with the mean of the
    /// bilinear interpolant over its area, so that pdf > 0 wherever the picture is not black, also where light only
    /// leaks in from a neighbour. A uniform environment is sampled uniformly. u, u_choice: independent, uniform in [0,
    /// 1). The sample's radiance and pdf are those of wi to rounding, by which a point on the border of a cell may
    /// count to its neighbour.
    EnvironmentSample sample(Vec2 u, float u_choice) const;
    /// Solid-angle density of sample() in a unit direction, over all strategies.
    float pdf(Vec3 direction) const;

    /// The picture on its own and the discs on their own, for those who sample both: one sample of all together goes to
    /// the sun most of the time, which is in vain where the sun is hidden.
    bool has_sky() const { return picture_.pixels.empty() ? luminance(uniform_) > 0 : picture_probability_ > 0; }
    bool has_sun() const { return !discs_.empty(); }
    /// As sample(), of one part; where it has light.
    EnvironmentSample sample_sky(Vec2 u) const;
    /// sample_sky with a grey radiance, the mean luminance of the cell: the picture is not looked at. Positive.
    EnvironmentSample estimate_sky(Vec2 u) const;
    EnvironmentSample sample_sun(Vec2 u, float u_choice) const;

    /// The picture in blocks, for those who know which parts of the sky can be seen: bands of about equal solid angle,
    /// from the zenith down, each cut into equal parts of the azimuth. Without a picture there are none.
    static constexpr int block_rows = 32, block_columns = 32, block_count = block_rows * block_columns;
    bool has_blocks() const { return !blocks_.empty(); }
    struct Block {
        double probability = 0, solid_angle = 0;  // that sample_sky finds it; sr
        int first_row = 0, first_column = 0, end_column = 0;
        Distribution1D row_choice;
    };
    const Block& block(int index) const { return blocks_[size_t(index)]; }
    /// estimate_sky within a block of positive probability. pdf is that of estimate_sky all the same.
    EnvironmentSample estimate_sky_in(const Block& block, Vec2 u) const;
    /// What the samples of a part are in a unit direction. radiance() is the sum of both radiances.
    EnvironmentSample sky(Vec3 direction) const;
    EnvironmentSample sun(Vec3 direction) const;

    /// Illuminance on a horizontal surface that faces up, in lux: by the picture's upper half, and by the discs, each
    /// of which counts as a point at its centre. These and mean_radiance take the interpolant as constant within a
    /// texel; the error is below 1e-3 for skies of 512 x 256 texels.
    double sky_illuminance() const { return sky_illuminance_; }
    double disc_illuminance() const;
    double horizontal_illuminance() const { return sky_illuminance() + disc_illuminance(); }
    /// Mean over all directions, discs included, in cd/m2. A scene of bounding radius R receives the luminous power 4
    /// pi^2 R^2 luminance(mean_radiance()).
    Rgb mean_radiance() const { return mean_radiance_; }
    /// Those that shine.
    const std::vector<Disc>& discs() const { return discs_; }

private:
    struct Source {  // of a disc's samples
        ShadingBasis basis;
        float one_minus_cos;
        float probability;  // among the discs
    };
    /// A direction without its radiance, and its place in the picture.
    std::pair<EnvironmentSample, Vec2> draw_from_picture(Vec2 u) const;
    std::pair<EnvironmentSample, Vec2> place(Distribution1D::Sample row, Distribution1D::Sample column) const;
    int block_of(int row, int column) const {
        return has_blocks() ? band_of_row_[size_t(row)] * block_columns + column * block_columns / columns_ : 0;
    }
    void make_blocks();
    Rgb picture_radiance(Vec2 uv) const;
    float cell_pdf(int row, int column) const;
    bool is_in_disc(size_t disc, Vec3 direction) const;
    void measure(const Image<Rgb>& means);
    void add_discs(const std::vector<Disc>& discs);

    Image<Rgb> picture_;  // no texels: uniform_ instead
    Rgb uniform_;
    float scale_ = 1;  // of the picture
    std::vector<Disc> discs_;
    std::vector<Source> sources_;  // one per disc
    float picture_probability_ = 1;
    double disc_illuminance_ = 0;
    int columns_ = 0, rows_ = 0;  // of cells for sampling
    Distribution1D row_choice_;
    std::vector<Distribution1D> column_choice_;  // per row
    std::vector<Block> blocks_;
    std::vector<uint8_t> band_of_row_;
    std::vector<double> row_edge_;  // sine of elevation at the upper edge of each row, and -1
    float picture_power_ = 0;       // integral of the picture's luminance over all directions
    double sky_illuminance_ = 0;
    Rgb mean_radiance_;
};

}  // namespace pluvia
