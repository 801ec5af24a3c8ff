#include "tools/sky_pictures.h"

#include "renderer/core/parallel.h"
#include "renderer/core/random.h"
#include "renderer/image/color.h"
#include "renderer/image/exposure.h"
#include "renderer/image/exr.h"
#include "renderer/image/image_io.h"

#include <cmath>
#include <numbers>

namespace pluvia {
namespace {

constexpr double pi_d = std::numbers::pi;
constexpr int margin = 6;       // pixels around a disc
constexpr double sky_gain = 1;  // stops; a meter shows a sky that fills the view darker than one likes to look at it

bool is_near_disc(const Environment& sky, Vec3 direction, float distance) {
    for (const Disc& disc : sky.discs())
        if (length(direction - disc.direction) < disc.angular_radius + distance) return true;
    return false;
}

/// Mean over a texel of 16 x 16 points.
Rgb mean_radiance(const Environment& sky, double u, double v, double du, double dv) {
    constexpr int n = 16;
    double r = 0, g = 0, b = 0;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const Rgb c = sky.radiance(direction_from_equirectangular(u + du * (i + 0.5) / n, v + dv * (j + 0.5) / n));
            r += c.r, g += c.g, b += c.b;
        }
    return Rgb(float(r), float(g), float(b)) / float(n * n);
}

}  // namespace

Image<Rgb> panorama(const Environment& sky, int width, int height) {
    Image<Rgb> picture(width, height);
    const auto texel = float(2 * pi_d / width);
    parallel_for(height, [&](int y) {
        for (int x = 0; x < width; ++x) {
            const Vec3 centre = direction_from_equirectangular((x + 0.5) / width, (y + 0.5) / height);
            picture.at(x, y) =
                is_near_disc(sky, centre, texel)
                    ? mean_radiance(sky, double(x) / width, double(y) / height, 1.0 / width, 1.0 / height)
                    : sky.radiance(centre);
        }
    });
    return picture;
}

void write_panorama(const std::string& path, const Image<Rgb>& picture, const std::string& settings) {
    ExrWriter writer(path, picture.width, picture.height, {{"R", false}, {"G", false}, {"B", false}},
                     {{"pluvia:version", PLUVIA_VERSION},
                      {"pluvia:settings", settings},
                      {"pluvia:units", "radiance: cd/m2, linear Rec.709"}});
    std::vector<float> planes[3];
    for (const Rgb& c : picture.pixels) {
        planes[0].push_back(c.r), planes[1].push_back(c.g), planes[2].push_back(c.b);
    }
    const ExrRows rows[3] = {planes[0].data(), planes[1].data(), planes[2].data()};
    writer.write_rows(0, picture.height, rows);
    writer.finish();
}

SkyStrip::SkyStrip(int columns, int rows, int size)
    : columns_(columns),
      size_(size),
      picture_(columns * (size + margin) + margin, rows * (size + margin) + margin, Rgba8{10, 10, 12, 255}) {}

double SkyStrip::add(int panel, const Environment& sky, std::optional<double> ev100, const std::string& view) {
    constexpr int samples = 4;  // per pixel in each direction: smooth rims
    struct Pixel {
        Rgb light;
        float inside = 0;
    };
    std::vector<Pixel> pixels(size_t(size_) * size_t(size_));
    parallel_for(size_, [&](int y) {
        for (int x = 0; x < size_; ++x) {
            Pixel& pixel = pixels[size_t(y) * size_t(size_) + size_t(x)];
            int inside = 0;
            for (int s = 0; s < samples * samples; ++s) {
                const double a = 2 * (x + (s % samples + 0.5) / samples) / size_ - 1;
                const double b = 2 * (y + (s / samples + 0.5) / samples) / size_ - 1;
                const double radius = std::hypot(a, b);
                if (radius >= 1) continue;
                // Seen from below: north up, east left.
                const Rgb c = sky.radiance(Vec3(direction_from_azimuth(std::atan2(-a, -b), 0.5 * pi_d * (1 - radius))));
                pixel.light += c;
                ++inside;
            }
            if (inside > 0) pixel.light = pixel.light / float(inside);
            pixel.inside = float(inside) / (samples * samples);
        }
    });
    LuminanceHistogram histogram;
    for (const Pixel& pixel : pixels) histogram.add(pixel.light);
    const double ev = ev100 ? *ev100 : histogram.auto_ev100() - sky_gain;
    std::vector<Rgb> shown;
    for (const Pixel& pixel : pixels) shown.push_back(pixel.light * exposure_scale(ev));
    DisplayView(view).apply(shown);
    const int left = margin + panel % columns_ * (size_ + margin), top = margin + panel / columns_ * (size_ + margin);
    for (int y = 0; y < size_; ++y)
        for (int x = 0; x < size_; ++x) {
            const size_t i = size_t(y) * size_t(size_) + size_t(x);
            Rgba8& out = picture_.at(left + x, top + y);
            // Half a step of noise, so that eight bits show no bands in a twilight.
            const float noise = (unit_float(hash_key(1, i, panel)) - 0.5f) / 255;
            const auto blend = [&](float value, uint8_t behind) {
                return byte_from_display((value + noise) * pixels[i].inside +
                                         float(behind) / 255 * (1 - pixels[i].inside));
            };
            out = {blend(shown[i].r, out.r), blend(shown[i].g, out.g), blend(shown[i].b, out.b), 255};
        }
    return ev;
}

void SkyStrip::write(const std::string& path, const std::string& settings) const {
    PngWriter writer(path, picture_.width, picture_.height, 3, 8,
                     {{"Software", std::string("Pluvia ") + PLUVIA_VERSION}, {"pluvia:settings", settings}});
    std::vector<uint8_t> bytes;
    for (const Rgba8& p : picture_.pixels) bytes.insert(bytes.end(), {p.r, p.g, p.b});
    writer.write_rows(0, picture_.height, bytes.data());
    writer.finish();
}

}  // namespace pluvia
