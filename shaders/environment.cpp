#include "shaders/environment.h"

#include "renderer/core/error.h"
#include "renderer/core/parallel.h"

#include <numbers>
#include <string>
#include <utility>

namespace pluvia {
namespace {

constexpr double pi_d = std::numbers::pi;

/// Mean of the linear interpolant between three texels over the middle one.
Rgb mean_of_interpolant(Rgb before, Rgb here, Rgb after) {
    return before * 0.125f + here * 0.75f + after * 0.125f;
}

/// Throws for what cannot be sampled, and clips negative components.
void check(Image<Rgb>& picture, const std::vector<Disc>& discs) {
    for (const Disc& disc : discs) {
        bool finite = disc.angular_radius > 0 && !disc.strips.empty();
        for (const Rgb& strip : disc.strips) finite = finite && is_finite(strip);
        if (!finite)
            throw input_error("environment", "a disc has no size or no finite radiance (got a radius of " +
                                                 std::to_string(disc.angular_radius) + " radians, expected above 0)");
    }
    if (picture.pixels.empty()) throw input_error("environment", "the picture is empty (expected at least one texel)");
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            Rgb& texel = picture.at(x, y);
            if (!is_finite(texel))
                throw input_error("environment", "texel (" + std::to_string(x) + ", " + std::to_string(y) +
                                                     ") is infinite or not a number (expected finite radiance)");
            texel = {std::max(0.0f, texel.r), std::max(0.0f, texel.g), std::max(0.0f, texel.b)};
        }
}

/// Arc tangent of y / x in the quadrant of (x, y), radians, within 3e-7; (0, 0) gives 0. A third of the time of
/// std::atan2, of which a look-up takes two. Source: Abramowitz and Stegun 1964, eq. 4.4.49.
float fast_atan2(float y, float x) {
    const float ax = std::abs(x), ay = std::abs(y), larger = std::max(ax, ay);
    const float t = larger > 0 ? std::min(ax, ay) / larger : 0, t2 = t * t;
    float a = 0.0028662257f;
    for (float c : {-0.0161657367f, 0.0429096138f, -0.0752896400f, 0.1065626393f, -0.1420889944f, 0.1999355085f,
                    -0.3333314528f, 1.0f})
        a = a * t2 + c;
    a *= t;
    if (ay > ax) a = pi / 2 - a;
    if (x < 0) a = pi - a;
    return std::copysign(a, y);
}

/// Of each texel the mean of the bilinear interpolant over its area.
Image<Rgb> texel_means(const Image<Rgb>& picture) {
    const int width = picture.width, height = picture.height;
    Image<Rgb> means(width, height);
    parallel_for(height, [&](int y) {
        std::vector<Rgb> columns(width);
        for (int x = 0; x < width; ++x)
            columns[x] = mean_of_interpolant(picture.at(x, std::max(y - 1, 0)), picture.at(x, y),
                                             picture.at(x, std::min(y + 1, height - 1)));
        for (int x = 0; x < width; ++x)
            means.at(x, y) =
                mean_of_interpolant(columns[x > 0 ? x - 1 : width - 1], columns[x], columns[x + 1 < width ? x + 1 : 0]);
    });
    return means;
}

/// Sine of the elevation at the upper edge of each of so many rows, and -1.
std::vector<double> row_edges(int rows) {
    std::vector<double> edges(rows + 1);
    for (int y = 0; y <= rows; ++y) edges[y] = std::cos(pi_d * y / rows);
    return edges;
}

/// Side in texels of the cells by which a picture is sampled: the largest whose even density within a cell raises the
/// second moment of radiance over density by no more than max_growth above that of single texels, and by which the
/// bands of blocks are still some rows high. Skies are smooth: a small part of the texels will do, and stays in the
/// cache.
int cell_side(const Image<Rgb>& means) {
    constexpr double max_growth = 1.05;
    constexpr int fewest_rows = 2 * Environment::block_rows;
    const int width = means.width, height = means.height;
    const std::vector<double> edges = row_edges(height);
    int side = 1;
    for (int next = 2; width % next == 0 && height % next == 0 && height / next >= fewest_rows; next *= 2) {
        double power = 0, second_moment = 0;
        for (int y = 0; y < height; y += next)
            for (int x = 0; x < width; x += next) {
                double solid_angle = 0, cell_power = 0, squares = 0;
                for (int i = y; i < y + next; ++i) {
                    const double omega = edges[i] - edges[i + 1];
                    for (int k = x; k < x + next; ++k) {
                        const double radiance = luminance(means.at(k, i));
                        solid_angle += omega, cell_power += omega * radiance, squares += omega * radiance * radiance;
                    }
                }
                power += cell_power;
                if (cell_power > 0) second_moment += squares * solid_angle / cell_power;
            }
        if (!(second_moment <= max_growth * power)) break;
        side = next;
    }
    return side;
}

}  // namespace

Vec3d direction_from_azimuth(double azimuth, double elevation) {
    return {std::cos(elevation) * std::sin(azimuth), std::sin(elevation), -std::cos(elevation) * std::cos(azimuth)};
}

Vec3 direction_from_equirectangular(double u, double v) {
    return Vec3(direction_from_azimuth((u - 0.25) * 2 * pi_d, (0.5 - v) * pi_d));
}

Vec2 equirectangular_from_direction(Vec3 d) {
    // The arc tangent of the elevation keeps its precision at the poles, where the arc sine of y would lose half of it.
    const float elevation = fast_atan2(d.y, std::sqrt(d.x * d.x + d.z * d.z));
    return {0.5f + fast_atan2(d.z, d.x) * (0.5f / pi), 0.5f - elevation * (1 / pi)};
}

float Disc::one_minus_cos() const {
    const float s = std::sin(0.5f * angular_radius);
    return 2 * s * s;
}

Rgb Disc::radiance(Vec3 towards) const {
    // The chord keeps the precision that the cosine of so small an angle has lost.
    const Vec3 offset = towards - direction;
    const float chord_squared = 2 * one_minus_cos(), x2 = length_squared(offset) / chord_squared;
    if (x2 > 1) return Rgb(0);
    const float c = std::sqrt(1 - x2);
    const Vec3 out = offset / std::sqrt(chord_squared);
    if (!(lit_from == Vec3()) && dot(out - direction * c, lit_from) < 0) return Rgb(0);
    const int count = int(strips.size());
    const float across = std::sqrt(direction.x * direction.x + direction.z * direction.z);
    // Height above the centre: the offset along the vertical's part across the direction.
    const float height = across > 0 ? (out.y - direction.y * dot(out, direction)) / across : 0;
    const Rgb strip = strips[size_t(std::clamp(int((height + 1) * 0.5f * float(count)), 0, count - 1))];
    return strip * ((1 - limb_darkening * (1 - c)) / (1 - limb_darkening / 3));
}

Rgb Disc::mean_radiance() const {
    // Of equal areas: rings and sectors.
    constexpr int rings = 64, sectors = 128;
    const ShadingBasis basis(direction);
    double r = 0, g = 0, b = 0;
    for (int i = 0; i < rings; ++i)
        for (int k = 0; k < sectors; ++k) {
            const Vec3 local = sample_cone({(float(i) + 0.5f) / rings, (float(k) + 0.5f) / sectors}, one_minus_cos());
            const Rgb here = radiance(basis.to_world(local));
            r += here.r, g += here.g, b += here.b;
        }
    constexpr double share = 1.0 / (rings * sectors);
    return {float(r * share), float(g * share), float(b * share)};
}

Environment Environment::uniform(Rgb radiance) {
    Environment environment;
    environment.uniform_ = environment.mean_radiance_ = radiance;
    environment.sky_illuminance_ = pi_d * luminance(radiance);
    return environment;
}

Environment::Environment(Image<Rgb> picture, const std::vector<Disc>& discs) : picture_(std::move(picture)) {
    check(picture_, discs);
    const Image<Rgb> means = texel_means(picture_);
    measure(means);
    const int side = cell_side(means);
    columns_ = picture_.width / side, rows_ = picture_.height / side;
    row_edge_ = row_edges(rows_);
    column_choice_.resize(rows_);
    std::vector<float> row_weights(rows_);
    const std::vector<double> edges = row_edges(picture_.height);
    parallel_for(rows_, [&](int row) {
        std::vector<float> weights(columns_);
        for (int column = 0; column < columns_; ++column) {
            double sum = 0;
            for (int y = row * side; y < (row + 1) * side; ++y)
                for (int x = column * side; x < (column + 1) * side; ++x)
                    sum += luminance(means.at(x, y)) * (edges[y] - edges[y + 1]);
            weights[column] = float(sum);
        }
        column_choice_[row] = Distribution1D(weights);
        row_weights[row] = float(column_choice_[row].total());
    });
    row_choice_ = Distribution1D(row_weights);
    make_blocks();
    add_discs(discs);
}

void Environment::make_blocks() {
    if (!(row_choice_.total() > 0)) return;
    band_of_row_.resize(size_t(rows_));
    for (int row = 0; row < rows_; ++row) {
        const double height = 0.5 * (row_edge_[row] + row_edge_[row + 1]);
        band_of_row_[row] = uint8_t(std::clamp(int((1 - height) / 2 * block_rows), 0, block_rows - 1));
    }
    blocks_.resize(block_count);
    parallel_for(block_count, [&](int index) {
        Block& block = blocks_[size_t(index)];
        const int band = index / block_columns, part = index % block_columns;
        const auto [first, end] = std::equal_range(band_of_row_.begin(), band_of_row_.end(), uint8_t(band));
        // Those with column * block_columns / columns_ == part.
        block.first_row = int(first - band_of_row_.begin());
        block.first_column = (part * columns_ + block_columns - 1) / block_columns;
        block.end_column = ((part + 1) * columns_ + block_columns - 1) / block_columns;
        std::vector<float> weights;
        for (int row = block.first_row; row < int(end - band_of_row_.begin()); ++row) {
            const double of_row = column_choice_[row].probability(block.first_column, block.end_column);
            weights.push_back(float(double(row_choice_.probability(row)) * of_row));
            block.solid_angle +=
                (row_edge_[row] - row_edge_[row + 1]) * (2 * pi_d / columns_) * (block.end_column - block.first_column);
        }
        if (weights.empty()) return;
        block.row_choice = Distribution1D(weights);
        block.probability = block.row_choice.total();
    });
}

void Environment::measure(const Image<Rgb>& means) {
    const std::vector<double> edges = row_edges(means.height);
    double r = 0, g = 0, b = 0;
    for (int y = 0; y < means.height; ++y) {
        double row_r = 0, row_g = 0, row_b = 0;
        for (int x = 0; x < means.width; ++x) {
            const Rgb mean = means.at(x, y);
            row_r += mean.r, row_g += mean.g, row_b += mean.b;
        }
        const double share = (edges[y] - edges[y + 1]) / (2 * means.width);  // of all directions, of one texel
        r += row_r * share, g += row_g * share, b += row_b * share;
        // Integral of sin(elevation) over the texel's part above the horizon.
        const double above = std::max(0.0, edges[y]), below = std::max(0.0, edges[y + 1]);
        sky_illuminance_ += luminance(Rgb(float(row_r), float(row_g), float(row_b))) * (above * above - below * below) *
                            (pi_d / means.width);
    }
    mean_radiance_ = {float(r), float(g), float(b)};
}

void Environment::add_discs(const std::vector<Disc>& discs) {
    const double picture = luminance(mean_radiance_);
    picture_power_ = float(4 * pi_d * picture);
    std::vector<double> power;
    double total = picture;
    for (const Disc& disc : discs) {
        const Rgb radiance = disc.mean_radiance();
        if (luminance(radiance) == 0) continue;
        const Rgb mean = radiance * (disc.one_minus_cos() / 2);  // its solid angle over that of the sphere
        mean_radiance_ += mean;
        disc_illuminance_ += 4 * pi_d * luminance(mean) * std::max(0.0f, disc.direction.y);
        discs_.push_back(disc);
        power.push_back(luminance(mean));
        total += power.back();
    }
    constexpr double floor = 0.05;  // a source that is weak overall may be all the light behind a corner
    double sum = 0;                 // of the discs
    for (const double p : power) sum += std::max(floor, p / total);
    const double sky = picture > 0 ? std::max(floor, picture / total) : 0;
    picture_probability_ = discs_.empty() ? 1 : float(sky / (sky + sum));
    for (size_t i = 0; i < discs_.size(); ++i)
        sources_.push_back({ShadingBasis(discs_[i].direction), discs_[i].one_minus_cos(),
                            float(std::max(floor, power[i] / total) / sum)});
}

void Environment::multiply(float factor) {
    uniform_ *= factor;
    scale_ *= factor;
    picture_power_ *= factor;
    for (Disc& disc : discs_)
        for (Rgb& strip : disc.strips) strip *= factor;
    disc_illuminance_ *= factor;
    sky_illuminance_ *= factor;
    mean_radiance_ *= factor;
}

double Environment::disc_illuminance() const {
    return disc_illuminance_;
}

Rgb Environment::radiance(Vec3 direction) const {
    return sky(direction).radiance + sun(direction).radiance;
}

float Environment::pdf(Vec3 direction) const {
    if (is_black()) return 0;
    return picture_probability_ * sky(direction).pdf + (1 - picture_probability_) * sun(direction).pdf;
}

EnvironmentSample Environment::sample(Vec2 u, float u_choice) const {
    if (is_black()) return {};
    const bool of_sky = u_choice < picture_probability_;
    EnvironmentSample s =
        of_sky ? sample_sky(u) : sample_sun(u, (u_choice - picture_probability_) / (1 - picture_probability_));
    const EnvironmentSample other = of_sky ? sun(s.wi) : sky(s.wi);
    s.radiance += other.radiance;
    const float share = of_sky ? picture_probability_ : 1 - picture_probability_;
    s.pdf = share * s.pdf + (1 - share) * other.pdf;
    return s;
}

EnvironmentSample Environment::sample_sky(Vec2 u) const {
    if (picture_.pixels.empty()) return {sample_sphere(u), uniform_, pdf_sphere};
    auto [s, uv] = draw_from_picture(u);
    s.radiance = picture_radiance(uv);
    return s;
}

EnvironmentSample Environment::estimate_sky(Vec2 u) const {
    if (picture_.pixels.empty()) return {sample_sphere(u), Rgb(luminance(uniform_)), pdf_sphere};
    EnvironmentSample s = draw_from_picture(u).first;
    s.radiance = Rgb(s.pdf * picture_power_);
    return s;
}

std::pair<EnvironmentSample, Vec2> Environment::draw_from_picture(Vec2 u) const {
    const auto row = row_choice_.sample(u.y);
    return place(row, column_choice_[row.cell].sample(u.x));
}

EnvironmentSample Environment::estimate_sky_in(const Block& block, Vec2 u) const {
    auto row = block.row_choice.sample(u.y);
    row.cell += block.first_row;
    const auto column = column_choice_[row.cell].sample(u.x, block.first_column, block.end_column);
    EnvironmentSample s = place(row, column).first;
    s.radiance = Rgb(s.pdf * picture_power_);
    return s;
}

std::pair<EnvironmentSample, Vec2> Environment::place(Distribution1D::Sample row, Distribution1D::Sample column) const {
    // In double: next to a pole single precision leaves only a few values between the edges of a row.
    const double top = row_edge_[row.cell], bottom = row_edge_[row.cell + 1];
    const double y = top + row.offset * (bottom - top);
    const auto radius = float(std::sqrt(std::max(0.0, (1 - y) * (1 + y))));
    const float across = (float(column.cell) + column.offset) / float(columns_), phi = 2 * pi * across;
    // Of the point that was drawn, not of the direction again: the texels are on their way sooner.
    const Vec2 uv{across, 0.5f - fast_atan2(float(y), radius) * (1 / pi)};
    const Vec3 wi(-radius * std::cos(phi), float(y), -radius * std::sin(phi));
    return {{wi, Rgb(0), cell_pdf(row.cell, column.cell), block_of(row.cell, column.cell)}, uv};
}

EnvironmentSample Environment::sample_sun(Vec2 u, float u_choice) const {
    size_t i = 0;
    for (; i + 1 < sources_.size() && u_choice >= sources_[i].probability; ++i) u_choice -= sources_[i].probability;
    return sun(sources_[i].basis.to_world(sample_cone(u, sources_[i].one_minus_cos)));
}

EnvironmentSample Environment::sky(Vec3 direction) const {
    if (picture_.pixels.empty()) return {direction, uniform_, pdf_sphere};
    const Vec2 uv = equirectangular_from_direction(direction);
    const int column = std::min(int(uv.x * float(columns_)), columns_ - 1);
    const int row = std::min(int(uv.y * float(rows_)), rows_ - 1);
    return {direction, picture_radiance(uv), cell_pdf(row, column), block_of(row, column)};
}

EnvironmentSample Environment::sun(Vec3 direction) const {
    EnvironmentSample s{direction, Rgb(0), 0};
    for (size_t i = 0; i < discs_.size(); ++i) {
        if (!is_in_disc(i, direction)) continue;
        s.radiance += discs_[i].radiance(direction);
        s.pdf += sources_[i].probability * pdf_cone(sources_[i].one_minus_cos);
    }
    return s;
}

bool Environment::is_in_disc(size_t disc, Vec3 direction) const {
    return length_squared(direction - discs_[disc].direction) <= 2 * sources_[disc].one_minus_cos;
}

float Environment::cell_pdf(int row, int column) const {
    const auto solid_angle = float((row_edge_[row] - row_edge_[row + 1]) * (2 * pi_d / columns_));
    return row_choice_.probability(row) * column_choice_[row].probability(column) / solid_angle;
}

Rgb Environment::picture_radiance(Vec2 uv) const {
    const int width = picture_.width, height = picture_.height;
    const float x = uv.x * float(width) - 0.5f;
    const float y = std::clamp(uv.y * float(height) - 0.5f, 0.0f, float(height - 1));
    const int column = int(std::floor(x)), row = int(y);
    const float tx = x - float(column), ty = y - float(row);
    const int left = column < 0 ? width - 1 : column;  // u reaches from 0 to 1, so that x lies
                                                       // in [-1/2, width - 1/2]
    const int right = column + 1 < width ? column + 1 : 0, below = std::min(row + 1, height - 1);
    return mix(mix(picture_.at(left, row), picture_.at(right, row), tx),
               mix(picture_.at(left, below), picture_.at(right, below), tx), ty) *
           scale_;
}

}  // namespace pluvia
