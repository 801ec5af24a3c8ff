// What HTML pages that need no other file are made of: style, pictures as URLs, two pictures under a slider.
#pragma once

#include "renderer/image/image.h"

#include <string>

namespace pluvia {

extern const std::string html_page_style;     // CSS
extern const std::string html_slider_script;  // makes every slider of a page move; goes behind them

/// Text with what HTML would read as markup replaced.
std::string html_escaped(const std::string& text);

/// A picture as the address of an <img>.
std::string png_url(const Image<Rgba8>& image);
/// quality: 1 to 100; alpha is dropped.
std::string jpeg_url(const Image<Rgba8>& image, int quality);

struct LabelledUrl {
    std::string label, url;
};
/// Two pictures of one size above each other; a line that can be dragged divides what is seen of each.
std::string html_slider(const LabelledUrl& left, const LabelledUrl& right);

}  // namespace pluvia
