#include "renderer/image/color.h"

#include "renderer/core/error.h"
#include "renderer/image/ocio_config.h"

#include <OpenColorIO/OpenColorIO.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace pluvia {
namespace {

namespace ocio = OCIO_NAMESPACE;

constexpr const char* display_name = "sRGB";

const ocio::ConstConfigRcPtr& config() {
    static const ocio::ConstConfigRcPtr parsed = [] {
        std::istringstream text(ocio_config);
        return ocio::Config::CreateFromStream(text);
    }();
    return parsed;
}

Rgb clip(Rgb c, float low, float high) {
    return {std::clamp(c.r, low, high), std::clamp(c.g, low, high), std::clamp(c.b, low, high)};
}

}  // namespace

float linear_from_srgb(float coded) {
    return coded <= 0.04045f ? coded / 12.92f : std::pow((coded + 0.055f) / 1.055f, 2.4f);
}

float srgb_from_linear(float linear) {
    return linear <= 0.0031308f ? linear * 12.92f : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

const std::array<float, 256>& linear_from_srgb8() {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> values;
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = linear_from_srgb(float(i) / 255);
        return values;
    }();
    return table;
}

// The comparison is false for NaN, whose conversion to an integer would be undefined.
uint8_t byte_from_display(float value) {
    return value > 0 ? uint8_t(std::min(value, 1.0f) * 255 + 0.5f) : 0;
}
uint16_t word_from_display(float value) {
    return value > 0 ? uint16_t(std::min(value, 1.0f) * 65535 + 0.5f) : 0;
}

const std::vector<std::string>& display_view_names() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> views;
        for (int i = 0; i < config()->getNumViews(display_name); ++i)
            views.push_back(config()->getView(display_name, i));
        return views;
    }();
    return names;
}

void check_display_view(const std::string& name) {
    const auto& names = display_view_names();
    if (std::ranges::find(names, name) != names.end()) return;
    std::string list;
    for (const std::string& known : names) list += (list.empty() ? "" : ", ") + known;
    throw usage_error("view", "unknown name (got " + name + ", expected one of " + list + ")");
}

struct DisplayView::Processor {
    ocio::ConstCPUProcessorRcPtr cpu;
};

DisplayView::DisplayView(const std::string& name) : processor_(std::make_unique<Processor>()) {
    check_display_view(name);
    processor_->cpu =
        config()
            ->getProcessor(ocio::ROLE_SCENE_LINEAR, display_name, name.c_str(), ocio::TRANSFORM_DIR_FORWARD)
            ->getOptimizedCPUProcessor(ocio::OPTIMIZATION_VERY_GOOD);
}

DisplayView::~DisplayView() = default;
DisplayView::DisplayView(DisplayView&&) noexcept = default;
DisplayView& DisplayView::operator=(DisplayView&&) noexcept = default;

void DisplayView::apply(std::span<Rgb> pixels) const {
    constexpr float brightest = 65504;  // where every view has long reached white; infinity would become NaN inside
    constexpr std::size_t block_size = 1024;
    std::array<bool, block_size> is_nan;  // some views turn NaN into black
    for (std::size_t start = 0; start < pixels.size(); start += block_size) {
        const auto block = pixels.subspan(start, std::min(block_size, pixels.size() - start));
        for (std::size_t i = 0; i < block.size(); ++i) {
            Rgb& p = block[i];
            is_nan[i] = std::isnan(p.r) || std::isnan(p.g) || std::isnan(p.b);
            p = clip(p, -brightest, brightest);
        }
        ocio::PackedImageDesc description(block.data(), long(block.size()), 1, 3);
        processor_->cpu->apply(description);
        for (std::size_t i = 0; i < block.size(); ++i) {
            Rgb& p = block[i];
            p = is_nan[i] ? Rgb(std::numeric_limits<float>::quiet_NaN()) : clip(p, 0, 1);
        }
    }
}

}  // namespace pluvia
