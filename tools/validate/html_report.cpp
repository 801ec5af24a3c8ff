#include "tools/validate/html_report.h"

#include "renderer/image/color.h"
#include "renderer/image/image_io.h"
#include "tools/frame_file.h"
#include "tools/html_parts.h"
#include "tools/validate/compare_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pluvia {
namespace {

using Ramp = std::array<Rgb, 5>;
constexpr Ramp heat = {Rgb(0.00f, 0.00f, 0.02f),
                       {0.32f, 0.07f, 0.48f},
                       {0.72f, 0.22f, 0.47f},
                       {0.99f, 0.54f, 0.38f},
                       {0.99f, 0.99f, 0.75f}};
constexpr Ramp sides = {Rgb(0.10f, 0.25f, 0.70f),
                        {0.55f, 0.70f, 0.95f},
                        {0.97f, 0.97f, 0.97f},
                        {0.97f, 0.65f, 0.50f},
                        {0.70f, 0.10f, 0.15f}};

Rgba8 rgba(Rgb c) {
    return {byte_from_display(c.r), byte_from_display(c.g), byte_from_display(c.b)};
}

/// t in 0..1.
Rgba8 color_at(const Ramp& ramp, float t) {
    const float place = std::clamp(t, 0.0f, 1.0f) * (ramp.size() - 1);
    const int i = std::min(int(place), int(ramp.size()) - 2);
    return rgba(mix(ramp[size_t(i)], ramp[size_t(i) + 1], place - float(i)));
}

template <class T, class Paint>
Image<Rgba8> painted(const Image<T>& image, Paint&& paint) {
    Image<Rgba8> result(image.width, image.height);
    for (size_t i = 0; i < image.pixels.size(); ++i) result.pixels[i] = paint(i);
    return result;
}

// ---- histograms

struct Histogram {
    std::string title, low, high;             // under the two ends of the axis
    std::vector<std::vector<double>> counts;  // one row of bins per curve
};
constexpr int histogram_bins = 120;

/// value: from 0 to 1 inside the axis; what lies outside is counted at its end.
template <class Value>
std::vector<double> count(size_t size, Value&& value) {
    std::vector<double> bins(histogram_bins, 0.0);
    for (size_t i = 0; i < size; ++i) {
        const double v = value(i);
        if (!std::isnan(v)) ++bins[size_t(std::clamp(v * histogram_bins, 0.0, histogram_bins - 1.0))];
    }
    return bins;
}

std::string drawn(const Histogram& h) {
    constexpr int width = 560, height = 160;
    constexpr const char* colors[] = {"#1f77b4", "#d62728"};
    double most = 1;
    for (const auto& bins : h.counts)
        for (const double n : bins) most = std::max(most, n);
    std::string svg = fmt::format("<h3>{}</h3><svg viewBox=\"0 0 {} {}\" width=\"{}\">", html_escaped(h.title), width,
                                  height + 20, width);
    for (size_t k = 0; k < h.counts.size(); ++k) {
        std::string points;
        for (int i = 0; i < histogram_bins; ++i) {
            // The logarithm shows the rare next to the frequent.
            const double y = height * (1 - std::log1p(h.counts[k][size_t(i)]) / std::log1p(most));
            points += fmt::format("{:.1f},{:.1f} {:.1f},{:.1f} ", double(i) * width / histogram_bins, y,
                                  (i + 1.0) * width / histogram_bins, y);
        }
        svg += fmt::format("<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\" points=\"{}\"/>", colors[k],
                           points);
        if (h.counts.size() > 1)
            svg += fmt::format("<text x=\"{}\" y=\"16\" fill=\"{}\" font-size=\"13\">{}</text>", 8 + 24 * k, colors[k],
                               k == 0 ? "A" : "B");
    }
    return svg + fmt::format(
                     "<text x=\"2\" y=\"{0}\" font-size=\"12\">{1}</text><text x=\"{2}\" y=\"{0}\" font-size=\"12\" "
                     "text-anchor=\"end\">{3}</text></svg>",
                     height + 15, html_escaped(h.low), width - 2, html_escaped(h.high));
}

// ---- what is shown of a pair

struct Views {
    Image<Rgba8> a, b, error, difference;
    std::string error_title, difference_title;
    std::vector<Histogram> histograms;
};

Views color_views(const ComparedPair& pair) {
    Views v;
    const Image<Rgb> a = displayed(pair.a, pair.result.white), b = displayed(pair.b, pair.result.white);
    v.a = painted(a, [&](size_t i) { return rgba(a.pixels[i]); });
    v.b = painted(b, [&](size_t i) { return rgba(b.pixels[i]); });
    const bool is_light = pair.result.kind == PictureKind::light;
    if (!pair.error.pixels.empty()) {
        v.error_title = fmt::format("{}, 0 (black) to 1 (white)", is_light ? "HDR-FLIP" : "FLIP");
        v.error = painted(pair.error, [&](size_t i) { return color_at(heat, pair.error.pixels[i]); });
        v.histograms.push_back({v.error_title.substr(0, v.error_title.find(',')) + " of pixels, logarithmic counts",
                                "0",
                                "1",
                                {count(pair.error.pixels.size(), [&](size_t i) { return pair.error.pixels[i]; })}});
    }
    const auto relative = [&](size_t i) {
        const float x = luminance(pair.a.color.pixels[i]), y = luminance(pair.b.color.pixels[i]);
        return (x - y) / std::max(std::abs(x) + std::abs(y), 1e-20f) * 2;
    };
    v.difference_title = "(A - B) / mean of both, luminance: blue -20 % or less, red +20 % or more";
    v.difference = painted(pair.b.color, [&](size_t i) { return color_at(sides, relative(i) / 0.4f + 0.5f); });
    const auto position = [&](const Image<Rgb>& image) {
        return count(image.pixels.size(), [&](size_t i) -> double {
            const double y = luminance(image.pixels[i]);
            return is_light ? (std::log10(std::max(y, 1e-30) / pair.result.white) + 4) / 6 : y;
        });
    };
    const auto power = [&](double p) { return fmt::format("{:.2g}", pair.result.white * std::pow(10, p)); };
    v.histograms.push_back({"luminance of pixels, logarithmic counts",
                            is_light ? power(-4) : "0",
                            is_light ? power(2) + " (logarithmic)" : "1",
                            {position(pair.a.color), position(pair.b.color)}});
    return v;
}

Views value_views(const ComparedPair& pair) {
    Views v;
    const bool is_mask = pair.result.kind == PictureKind::mask;
    float farthest = 0;
    for (const float z : pair.b.value.pixels)
        if (std::isfinite(z)) farthest = std::max(farthest, z);
    // Near is bright, as in disparity; no depth is black.
    const auto grey = [&](float z) {
        if (is_mask) return Rgb(z >= 0.5f ? 1.0f : 0.0f);
        return std::isfinite(z) && z > 0 ? Rgb(1 - 0.85f * std::log1p(z) / std::log1p(farthest)) : Rgb(0);
    };
    v.a = painted(pair.a.value, [&](size_t i) { return rgba(grey(pair.a.value.pixels[i])); });
    v.b = painted(pair.b.value, [&](size_t i) { return rgba(grey(pair.b.value.pixels[i])); });
    v.error_title = is_mask ? "differs: white" : "|A - B| / B, 0 (black) to 25 % (white)";
    v.error = painted(pair.error, [&](size_t i) { return color_at(heat, pair.error.pixels[i] * (is_mask ? 1 : 4)); });
    if (is_mask) return v;
    const auto position = [&](const Image<float>& z) {
        return count(z.pixels.size(), [&](size_t i) -> double {
            return std::isfinite(z.pixels[i]) && z.pixels[i] > 0 ? z.pixels[i] / farthest
                                                                 : std::numeric_limits<double>::quiet_NaN();
        });
    };
    v.histograms.push_back({"depth of pixels, logarithmic counts",
                            "0",
                            fmt::format("{:.4g} m", farthest),
                            {position(pair.a.value), position(pair.b.value)}});
    v.histograms.push_back({"|A - B| / B of pixels, logarithmic counts",
                            "0",
                            "25 %",
                            {count(pair.error.pixels.size(), [&](size_t i) { return pair.error.pixels[i] * 4; })}});
    return v;
}

std::string map(const std::string& title, const Image<Rgba8>& image) {
    return image.pixels.empty() ? ""
                                : fmt::format("<div class=\"map\"><h3>{}</h3><img alt=\"\" src=\"{}\"></div>",
                                              html_escaped(title), png_url(image));
}

}  // namespace

void HtmlReport::add(const ComparedPair& pair) {
    if (sections_.size() >= most_pictures_) return;
    const bool is_color = pair.result.kind == PictureKind::light || pair.result.kind == PictureKind::display;
    const Views v = is_color ? color_views(pair) : value_views(pair);
    std::string html = fmt::format("<h2>{}</h2>{}", html_escaped(pair.result.name),
                                   html_slider({"A", png_url(v.a)}, {"B", png_url(v.b)}));
    html += "<div class=\"row\">" + map(v.error_title, v.error) + map(v.difference_title, v.difference) + "</div>";
    html += "<div class=\"row\">";
    for (const Histogram& histogram : v.histograms) html += "<div>" + drawn(histogram) + "</div>";
    sections_.push_back(html + "</div>");
}

void HtmlReport::write(const std::string& path, const std::string& a, const std::string& b,
                       const std::vector<PairResult>& pairs) const {
    std::string html =
        "<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\"><title>pluvia validate compare</title><style>";
    html += html_page_style + "</style></head><body><h1>pluvia validate compare</h1><pre>" +
            html_escaped(compare_table(a, b, pairs)) + "</pre>";
    if (sections_.size() < pairs.size())
        html +=
            fmt::format("<p class=\"note\">Pictures of the first {} of {} pairs.</p>", sections_.size(), pairs.size());
    for (const std::string& section : sections_) html += section;
    html += "<h2>Definitions</h2><p class=\"note\">A is judged, B is the reference.</p><pre>";
    for (const MetricInfo& info : metric_list())
        html += html_escaped(fmt::format("{:<16}{}\n", info.name, info.definition));
    write_text(path, html + "</pre><script>" + html_slider_script + "</script></body></html>\n");
}

}  // namespace pluvia
