// Small copies of pictures, for pages and figures.
#pragma once

#include "renderer/image/image.h"

namespace pluvia {

/// At most so many pixels wide, by means over whole pixels of the displayed values; the picture itself when it is
/// narrower.
Image<Rgba8> shrunk(const Image<Rgba8>& image, int most_width);

}  // namespace pluvia
