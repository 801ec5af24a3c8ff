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

/// Arc tangent of y / x in the quadrant of (x, y), radians, within 3e-7; (0, 0)
/// gives 0. A third of the time of std::atan2, of which a look-up takes two.
/// Source: Abramowitz and Stegun 1964, eq. 4.4.49.
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

/// Sums over one row, of the interpolant's means over its texels.
struct RowSums {
    double r = 0, g = 0, b = 0;
};

}  // namespace

Vec3d direction_from_azimuth(double azimuth, double elevation) {
    return {std::cos(elevation) * std::sin(azimuth), std::sin(elevation), -std::cos(elevation) * std::cos(azimuth)};
}

Vec2 equirectangular_from_direction(Vec3 d) {
    // The arc tangent of the elevation keeps its precision at the poles, where
    // the arc sine of y would lose half of it.
    const float elevation = fast_atan2(d.y, std::sqrt(d.x * d.x + d.z * d.z));
    return {0.5f + fast_atan2(d.z, d.x) * (0.5f / pi), 0.5f - elevation * (1 / pi)};
}

float Disc::one_minus_cos() const {
    const float s = std::sin(0.5f * angular_radius);
    return 2 * s * s;
}

Rgb Disc::radiance(Vec3 towards) const {
    // The chord keeps the precision that the cosine of so small an angle has
    // lost.
    const Vec3 offset = towards - direction;
    const float chord_squared = 2 * one_minus_cos(), x2 = length_squared(offset) / chord_squared;
    if (x2 > 1) return Rgb(0);
    const float c = std::sqrt(1 - x2);
    const Vec3 out = offset / std::sqrt(chord_squared);
    if (!(lit_from == Vec3()) && dot(out - direction * c, lit_from) < 0) return Rgb(0);
    const int count = int(strips.size());
    const float across = std::sqrt(direction.x * direction.x + direction.z * direction.z);
    // Height above the centre: the offset along the vertical's part across the
    // direction.
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
    const int width = picture_.width, height = picture_.height;

    row_edge_.resize(height + 1);
    for (int y = 0; y <= height; ++y) row_edge_[y] = std::cos(pi_d * y / height);

    column_choice_.resize(height);
    std::vector<RowSums> sums(height);
    parallel_for(height, [&](int y) {
        std::vector<Rgb> column_means(width);
        for (int x = 0; x < width; ++x)
            column_means[x] = mean_of_interpolant(picture_.at(x, std::max(y - 1, 0)), picture_.at(x, y),
                                                  picture_.at(x, std::min(y + 1, height - 1)));
        std::vector<float> weights(width);
        for (int x = 0; x < width; ++x) {
            const Rgb mean = mean_of_interpolant(column_means[x > 0 ? x - 1 : width - 1], column_means[x],
                                                 column_means[x + 1 < width ? x + 1 : 0]);
            weights[x] = luminance(mean);
            sums[y].r += mean.r, sums[y].g += mean.g, sums[y].b += mean.b;
        }
        column_choice_[y] = Distribution1D(weights);
    });

    std::vector<float> row_weights(height);
    RowSums mean;
    for (int y = 0; y < height; ++y) {
        const double top = row_edge_[y], bottom = row_edge_[y + 1];
        const double solid_angle = (top - bottom) * (2 * pi_d / width);  // of each of the row's texels
        const double row_luminance = column_choice_[y].total();
        row_weights[y] = float(row_luminance * solid_angle);
        const double share = solid_angle / (4 * pi_d);
        mean.r += sums[y].r * share, mean.g += sums[y].g * share, mean.b += sums[y].b * share;
        // Integral of sin(elevation) over the texel's part above the horizon.
        const double above = std::max(0.0, top), below = std::max(0.0, bottom);
        sky_illuminance_ += row_luminance * (above * above - below * below) * (pi_d / width);
    }
    row_choice_ = Distribution1D(row_weights);

    mean_radiance_ = {float(mean.r), float(mean.g), float(mean.b)};
    add_discs(discs);
}

void Environment::add_discs(const std::vector<Disc>& discs) {
    const double picture = luminance(mean_radiance_);
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
    constexpr double floor = 0.05;  // a source that is weak overall may be all the
                                    // light behind a corner
    double sum = picture > 0 ? std::max(floor, picture / total) : 0;
    for (const double p : power) sum += std::max(floor, p / total);
    if (sum > 0 && picture == 0) picture_probability_ = 0;
    if (picture > 0) picture_probability_ = float(std::max(floor, picture / total) / sum);
    for (size_t i = 0; i < discs_.size(); ++i)
        sources_.push_back({ShadingBasis(discs_[i].direction), discs_[i].one_minus_cos(),
                            float(std::max(floor, power[i] / total) / sum)});
}

void Environment::multiply(float factor) {
    uniform_ *= factor;
    scale_ *= factor;
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
    if (picture_.pixels.empty()) return uniform_;
    return radiance_at(equirectangular_from_direction(direction), direction);
}

float Environment::pdf(Vec3 direction) const {
    if (is_black()) return 0;
    if (picture_.pixels.empty()) return pdf_sphere;
    return pdf_at(equirectangular_from_direction(direction), direction);
}

EnvironmentSample Environment::sample(Vec2 u, float u_choice) const {
    if (is_black()) return {};
    if (picture_.pixels.empty()) return {sample_sphere(u), uniform_, pdf_sphere};
    Vec3 wi;
    size_t i = 0;
    for (; i < sources_.size() && u_choice >= sources_[i].probability; ++i) u_choice -= sources_[i].probability;
    if (i < sources_.size())
        wi = sources_[i].basis.to_world(sample_cone(u, sources_[i].one_minus_cos));
    else if (picture_probability_ > 0)
        wi = sample_picture(u);
    else  // rounding has left a little beyond the last disc
        wi = discs_.back().direction;
    const Vec2 uv = equirectangular_from_direction(wi);
    return {wi, radiance_at(uv, wi), pdf_at(uv, wi)};
}

bool Environment::is_in_disc(size_t disc, Vec3 direction) const {
    return length_squared(direction - discs_[disc].direction) <= 2 * sources_[disc].one_minus_cos;
}

Rgb Environment::radiance_at(Vec2 uv, Vec3 direction) const {
    Rgb sum = picture_radiance(uv);
    for (size_t i = 0; i < discs_.size(); ++i)
        if (is_in_disc(i, direction)) sum += discs_[i].radiance(direction);
    return sum;
}

float Environment::pdf_at(Vec2 uv, Vec3 direction) const {
    float sum = picture_probability_ * picture_pdf(uv);
    for (size_t i = 0; i < discs_.size(); ++i)
        if (is_in_disc(i, direction)) sum += sources_[i].probability * pdf_cone(sources_[i].one_minus_cos);
    return sum;
}

Vec3 Environment::sample_picture(Vec2 u) const {
    const auto row = row_choice_.sample(u.y);
    const auto column = column_choice_[row.cell].sample(u.x);
    // In double: next to a pole single precision leaves only a few values between
    // the edges of a row.
    const double top = row_edge_[row.cell], bottom = row_edge_[row.cell + 1];
    const double y = top + row.offset * (bottom - top);
    const auto radius = float(std::sqrt(std::max(0.0, (1 - y) * (1 + y))));
    const float phi = (float(column.cell) + column.offset) * (2 * pi / float(picture_.width));
    return {-radius * std::cos(phi), float(y), -radius * std::sin(phi)};
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

float Environment::picture_pdf(Vec2 uv) const {
    const int width = picture_.width, height = picture_.height;
    const int column = std::min(int(uv.x * float(width)), width - 1);
    const int row = std::min(int(uv.y * float(height)), height - 1);
    const auto solid_angle = float((row_edge_[row] - row_edge_[row + 1]) * (2 * pi_d / width));
    return row_choice_.probability(row) * column_choice_[row].probability(column) / solid_angle;
}

}  // namespace pluvia
