// The spectrum of skylight in 12 bands, and what the eye makes of them. A band holds a part of the sun's light outside
// the atmosphere, so that transfer through air is a number without unit per band.
#pragma once

#include "renderer/core/rgb.h"

#include <array>
#include <bit>
#include <cstdint>

namespace pluvia {

constexpr int band_count = 12;  // of 27.5 nm, from 390 to 720 nm

/// One number per band. Loops of fixed length over floats, which compilers turn into vector instructions.
struct Bands {
    alignas(16) std::array<float, band_count> v = {};

    constexpr Bands() = default;
    constexpr explicit Bands(float all) { v.fill(all); }
    float operator[](int i) const { return v[size_t(i)]; }
    float& operator[](int i) { return v[size_t(i)]; }
    Bands& operator+=(const Bands& b) {
        for (size_t i = 0; i < band_count; ++i) v[i] += b.v[i];
        return *this;
    }
    Bands& operator*=(const Bands& b) {
        for (size_t i = 0; i < band_count; ++i) v[i] *= b.v[i];
        return *this;
    }
    friend Bands operator+(Bands a, const Bands& b) { return a += b; }
    friend Bands operator*(Bands a, const Bands& b) { return a *= b; }
    friend Bands operator*(Bands a, float s) {
        for (float& x : a.v) x *= s;
        return a;
    }
};

/// exp(-x) for x >= 0, relative error below 3e-7; beyond 87 it stays at 1e-38.
inline Bands exp_minus(const Bands& x) {
    Bands result;
    for (size_t i = 0; i < band_count; ++i) {
        const float y = -(x.v[i] < 87.0f ? x.v[i] : 87.0f);
        // y = n ln 2 + r with whole n; adding 1.5 * 2^23 rounds to whole numbers.
        const float shifted = y * 1.44269504f + 12582912.0f, n = shifted - 12582912.0f;
        const float r = (y - n * 0.693359375f) + n * 2.12194440e-4f;
        float p = 1.98756915e-4f;  // minimax polynomial of Moshier's Cephes library, expf
        p = p * r + 1.39819995e-3f;
        p = p * r + 8.33345193e-3f;
        p = p * r + 4.16657962e-2f;
        p = p * r + 1.66666656e-1f;
        p = p * r + 0.5f;
        const float e = p * r * r + r + 1;
        result.v[i] = e * std::bit_cast<float>((int32_t(n) + 127) << 23);
    }
    return result;
}

/// (1 - exp(-x)) / x for x >= 0, of which `exp_minus_x` = exp(-x): the mean transmittance of a step of depth x.
inline Bands mean_transmittance(const Bands& x, const Bands& exp_minus_x) {
    Bands result;
    for (size_t i = 0; i < band_count; ++i) {
        const float t = x.v[i], series = 1 - t * (0.5f - t * (1.0f / 6 - t * (1.0f / 24)));
        const float exact = (1 - exp_minus_x.v[i]) / (t > 0.05f ? t : 1.0f);
        result.v[i] = t > 0.05f ? exact : series;  // the difference cancels where x is small
    }
    return result;
}

/// CIE 1931 XYZ.
struct Xyz {
    double x = 0, y = 0, z = 0;
};

struct SpectralBand {
    double wavelength;  // micrometres, of its middle
    Xyz sun;            // the sun's light at 1 AU outside the atmosphere in this band, as
                        // illuminance in lux
    double ozone;       // optical depth of 300 DU of ozone
};
/// Sources: ASTM G173 extraterrestrial spectrum; CIE 1931 2-degree observer; ozone at 233 K, Serdyuchenko et al. 2014.
extern const std::array<SpectralBand, band_count> bands;

/// Light whose part of the sun's light in each band is `transfer`: illuminance in lux for a part of irradiance,
/// luminance in cd/m2 for a part per steradian.
Xyz xyz_from_bands(const Bands& transfer);
/// Its luminance alone.
double luminance_from_bands(const Bands& transfer);

/// Linear Rec.709 with the luminance of CIE 1931 XYZ (matrix of IEC 61966-2-1). Colours that lie outside the gamut are
/// moved towards grey at constant luminance until no component is negative. y must not be negative.
Rgb rec709_from_xyz(const Xyz& c);
Xyz xyz_from_rec709(Rgb c);

}  // namespace pluvia
