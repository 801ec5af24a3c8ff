// Everything about display colour: views from scene-linear light to a screen, and the sRGB curve; the OpenColorIO door.
// How bright the scene is shown is decided before, in exposure.h.
#pragma once

#include "renderer/core/rgb.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace pluvia {

/// Linear value of an sRGB-coded one; both 0..1, outside continued by the same formula (odd below 0).
/// Source: IEC 61966-2-1:1999, section 5.2.
float linear_from_srgb(float coded);
/// sRGB-coded value of a linear one. Source: IEC 61966-2-1:1999, section 5.3.
float srgb_from_linear(float linear);
/// linear_from_srgb(i / 255) for every byte i, for textures.
const std::array<float, 256>& linear_from_srgb8();

/// Display value 0..1 to the nearest integer of 8 or 16 bits; values outside are clipped. NaN gives 0: count it before.
uint8_t byte_from_display(float value);
uint16_t word_from_display(float value);

/// Names that DisplayView takes, in the order shown to users: srgb, filmic, aces, raw.
const std::vector<std::string>& display_view_names();
/// Throws Error (usage) with the list of names for any other: before a picture is rendered that could not be shown.
void check_display_view(const std::string& name);

/// A way to show scene-linear Rec.709 light on an sRGB display. Measured on one core, 2048 x 1024 pixels: srgb 0.05 s,
/// filmic 0.1 s, aces 0.24 s, raw 0.02 s.
/// srgb: exact curve, clipped at 1. filmic: 16.5 stops, highlights lose colour, 0.18 shows near 0.5, white at 16.
/// aces: ACES 1.0 SDR output transform. raw: linear, clipped, for data.
class DisplayView {
public:
    /// Throws as check_display_view does.
    explicit DisplayView(const std::string& name);
    ~DisplayView();
    DisplayView(DisplayView&&) noexcept;
    DisplayView& operator=(DisplayView&&) noexcept;

    /// Turns light, exposed so that 1 is display white in srgb, into display-coded values from 0 to 1, in place.
    /// Infinite light shows as the brightest the view has; a pixel with a NaN becomes NaN in all three, so that it can
    /// be counted. May be called by many threads at the same time.
    void apply(std::span<Rgb> pixels) const;

private:
    struct Processor;
    std::unique_ptr<Processor> processor_;
};

}  // namespace pluvia
