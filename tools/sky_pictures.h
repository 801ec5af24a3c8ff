// Pictures of a sky: a panorama for other programs, and discs of the hours of a day to look at.
#pragma once

#include "renderer/image/image.h"
#include "shaders/environment.h"

#include <optional>
#include <string>
#include <vector>

namespace pluvia {

/// Equirectangular picture in cd/m2 with the map of environment.h, the discs of sun and moon spread over the texels
/// that they touch, so that read back it gives the same illuminance. width is twice height.
Image<Rgb> panorama(const Environment& sky, int width, int height);
/// As an EXR file of R, G, B.
void write_panorama(const std::string& path, const Image<Rgb>& picture, const std::string& settings);

/// The sky from horizon to horizon as seen lying on the back with the feet to the south: zenith in the centre, east on
/// the left. Several of them in rows. size: pixels of one's diameter.
class SkyStrip {
public:
    SkyStrip(int columns, int rows, int size);
    /// Returns the exposure value that the sky is shown at: ev100, or a stop below automatic exposure.
    double add(int panel, const Environment& sky, std::optional<double> ev100, const std::string& view);
    void write(const std::string& path, const std::string& settings) const;

private:
    int columns_, size_;
    Image<Rgba8> picture_;
};

}  // namespace pluvia
