// Display colour and exposure: known patches, monotone views, and metering that a few bright pixels cannot move.
#include "renderer/image/color.h"
#include "renderer/core/error.h"
#include "renderer/core/random.h"
#include "renderer/image/exposure.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using namespace pluvia;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

Rgb shown(const DisplayView& view, Rgb light) {
    view.apply(std::span(&light, 1));
    return light;
}
float grey_shown(const DisplayView& view, float light) {
    return shown(view, Rgb(light)).g;
}

}  // namespace

TEST_CASE("the sRGB curve has its published values and inverts") {
    // IEC 61966-2-1 evaluated in double precision; 1e-6 is a few roundings of float
    CHECK(linear_from_srgb(0.5f) == doctest::Approx(0.2140411405).epsilon(1e-6).scale(0));
    CHECK(srgb_from_linear(0.18f) == doctest::Approx(0.4613561295).epsilon(1e-6).scale(0));
    CHECK(linear_from_srgb(0.02f) == doctest::Approx(0.02 / 12.92).epsilon(1e-6).scale(0));
    CHECK(linear_from_srgb(0) == 0);
    CHECK(srgb_from_linear(0) == 0);
    CHECK(linear_from_srgb(1) == doctest::Approx(1).epsilon(1e-6));
    const auto& table = linear_from_srgb8();
    for (int i = 0; i < 256; ++i) {
        CAPTURE(i);
        CHECK(byte_from_display(srgb_from_linear(table[std::size_t(i)])) == i);
        if (i > 0) CHECK(table[std::size_t(i)] > table[std::size_t(i - 1)]);
    }
}

TEST_CASE("display values round to the nearest integer and NaN to black") {
    CHECK(byte_from_display(0) == 0);
    CHECK(byte_from_display(1) == 255);
    CHECK(byte_from_display(0.499f / 255) == 0);
    CHECK(byte_from_display(0.501f / 255) == 1);
    CHECK(byte_from_display(-1) == 0);
    CHECK(byte_from_display(infinity) == 255);
    CHECK(byte_from_display(not_a_number) == 0);
    CHECK(word_from_display(1) == 65535);
    CHECK(word_from_display(0.5f) == 32768);
    CHECK(word_from_display(7) == 65535);
    CHECK(word_from_display(not_a_number) == 0);
}

TEST_CASE("the views are srgb, filmic, aces and raw, and an unknown one lists them") {
    CHECK(display_view_names() == std::vector<std::string>{"srgb", "filmic", "aces", "raw"});
    for (const std::string& name : display_view_names()) CHECK_NOTHROW(check_display_view(name));
    for (const bool only_its_name : {true, false}) {
        try {
            if (only_its_name)
                check_display_view("agx");
            else
                const DisplayView view("agx");
            FAIL("no error");
        } catch (const Error& e) {
            CHECK(e.code() == ExitCode::usage);
            CHECK(std::string(e.what()) == "view: unknown name (got agx, expected one of srgb, filmic, aces, raw)");
        }
    }
}

TEST_CASE("the srgb view is the sRGB curve, clipped") {
    const DisplayView view("srgb");
    for (float light = 1e-5f; light < 1; light *= 1.03f) {
        CAPTURE(light);
        // 2e-5: the library's power is approximate; a two-hundredth of a step of 8 bits
        CHECK(std::abs(grey_shown(view, light) - srgb_from_linear(light)) < 2e-5f);
    }
    CHECK(shown(view, {4, 0, -1}) == Rgb(1, 0, 0));
    CHECK(grey_shown(view, 1) > 1 - 2e-5f);
}

TEST_CASE("the raw view only clips") {
    const DisplayView view("raw");
    CHECK(shown(view, {0.25f, 1.5f, -0.5f}) == Rgb(0.25f, 1, 0));
}

TEST_CASE("the aces view gives the published grey patches") {
    const DisplayView view("aces");
    // ACES 1.0 SDR video as computed by the reference configuration with OpenColorIO's tools, three digits
    CHECK(grey_shown(view, 0.18f) == doctest::Approx(0.356).epsilon(0.0015).scale(0));
    CHECK(grey_shown(view, 1) == doctest::Approx(0.812).epsilon(0.0007));
    CHECK(grey_shown(view, 4) == doctest::Approx(0.955).epsilon(0.0006));
    const Rgb grey = shown(view, Rgb(0.5f));
    CHECK(grey.r == doctest::Approx(grey.b).epsilon(1e-3).scale(0));  // the white point is kept through ACES' own
}

TEST_CASE("the filmic view shows 16.5 stops around a grey of one half") {
    const DisplayView view("filmic");
    CHECK(grey_shown(view, 0.18f) == doctest::Approx(0.5).epsilon(0.002));
    CHECK(grey_shown(view, 1) < 0.82f);    // display white of srgb is far from white
    CHECK(grey_shown(view, 16) > 0.999f);  // 16.3 is
    CHECK(grey_shown(view, 8) < 0.99f);
    CHECK(grey_shown(view, 0.0003f) > 0.0005f);
    CHECK(grey_shown(view, 0.0001f) == 0);  // 2^-12.47 is black
    CHECK(grey_shown(view, 0) == 0);
}

TEST_CASE("a colour loses its colour in filmic highlights and keeps it below") {
    const DisplayView view("filmic");
    const auto saturation = [&](float light) {
        const Rgb c = shown(view, Rgb(light, light * 0.05f, light * 0.05f));
        return (c.r - c.g) / c.r;
    };
    CHECK(saturation(0.18f) > 0.75f);
    for (float light = 0.2f; light < 300; light *= 1.5f) {
        CAPTURE(light);
        CHECK(saturation(light * 1.5f) < saturation(light));
    }
    CHECK(saturation(300) < 0.05f);
}

TEST_CASE("more grey light never shows darker") {
    for (const std::string& name : display_view_names()) {
        CAPTURE(name);
        const DisplayView view(name);
        std::vector<Rgb> ramp;
        for (float stops = -16; stops < 20; stops += 1.0f / 256) ramp.push_back(Rgb(std::exp2(stops)));
        view.apply(ramp);
        int falls = 0;
        for (std::size_t i = 1; i < ramp.size(); ++i)
            // 2e-6: single-precision steps inside the library, far below one of 16 bits
            falls += ramp[i].r < ramp[i - 1].r - 2e-6f || ramp[i].b < ramp[i - 1].b - 2e-6f;
        CHECK(falls == 0);
        CHECK(ramp.front().r < 0.001f);
        CHECK(ramp.back() == Rgb(1));
    }
}

TEST_CASE("every view keeps NaN countable and shows infinite light as white") {
    for (const std::string& name : display_view_names()) {
        CAPTURE(name);
        const DisplayView view(name);
        std::vector<Rgb> pixels(3000, Rgb(0.18f));
        pixels[5] = {0.5f, not_a_number, 0.5f};
        pixels[2500] = Rgb(infinity);
        pixels[2501] = {-infinity, infinity, 1};
        view.apply(pixels);
        int nan_count = 0, out_of_range = 0;
        for (const Rgb p : pixels) {
            const bool is_nan = std::isnan(p.r) && std::isnan(p.g) && std::isnan(p.b);
            nan_count += is_nan;
            out_of_range += !is_nan && !(std::min({p.r, p.g, p.b}) >= 0 && max_component(p) <= 1);
        }
        CHECK(nan_count == 1);
        CHECK(out_of_range == 0);
        CHECK(pixels[2500] == Rgb(1));
        CHECK(pixels[4] == pixels[2999]);
    }
}

TEST_CASE("a pixel shows the same alone and among others") {
    std::vector<Rgb> pixels;
    for (uint64_t i = 0; i < 2500; ++i)
        pixels.push_back({4 * unit_float(hash_key(3, i)), unit_float(hash_key(4, i)), 9 * unit_float(hash_key(5, i))});
    for (const std::string& name : display_view_names()) {
        const DisplayView view(name);
        std::vector<Rgb> together = pixels;
        view.apply(together);
        int different = 0;
        for (std::size_t i = 0; i < pixels.size(); ++i) different += shown(view, pixels[i]) != together[i];
        CHECK(different == 0);
    }
}

TEST_CASE("one more exposure value halves the picture") {
    CHECK(exposure_scale(0) == doctest::Approx(1 / 1.2));
    CHECK(exposure_scale(15) == doctest::Approx(1 / (1.2 * 32768)));
    CHECK(exposure_scale(11.5) == doctest::Approx(2 * exposure_scale(12.5)));
}

TEST_CASE("automatic exposure is a light meter's by day, half a stop darker by night, and leaves dark nights dark") {
    struct Level {
        double light, ev100;
    };
    // 4000 cd/m2 is paper in the sun; log2(8 * 4000) = 14.97, log2(8 * 64) = 9, log2(8 * 8) = 6, log2(8 * 0.5) = 2.
    for (const Level level : {Level{4000, 14.97}, Level{64, 9}, Level{8, 6.25}, Level{0.5, 2.5}, Level{0.125, 0.875},
                              Level{0.015625, 0.125}, Level{1e-4, -1.697}}) {
        LuminanceHistogram histogram;
        for (int i = 0; i < 1000; ++i) histogram.add(Rgb(float(level.light)));
        CAPTURE(level.light);
        CHECK(std::abs(histogram.auto_ev100() - level.ev100) < 0.02);  // a bin's centre is at most 1/64 away
    }
}

TEST_CASE("automatic exposure never jumps and never falls as light grows") {
    double before = min_auto_ev100;
    for (double stop = -16; stop < 20; stop += 1.0 / 32) {
        LuminanceHistogram histogram;
        histogram.add(Rgb(float(std::exp2(stop + 1.0 / 64))));
        const double now = histogram.auto_ev100();
        CHECK(now >= before);
        CHECK(now - before < 1.01 / 32);  // a stop more of light is at most a stop more of exposure
        before = now;
    }
}

TEST_CASE("a few very bright and very dark pixels do not move the exposure") {
    LuminanceHistogram plain, with_outliers;
    for (int i = 0; i < 920; ++i) {
        plain.add(Rgb(20));
        with_outliers.add(Rgb(20));
    }
    for (int i = 0; i < 20; ++i) {
        with_outliers.add(Rgb(1.6e9f));  // the sun's disk
        with_outliers.add(Rgb(infinity));
        with_outliers.add(Rgb(1e-6f));
        with_outliers.add(Rgb(1e-30f));
    }
    CHECK(with_outliers.auto_ev100() == plain.auto_ev100());
}

TEST_CASE("pixels without light are not metered") {
    LuminanceHistogram plain, with_black;
    plain.add(Rgb(20));
    with_black.add(Rgb(20));
    for (int i = 0; i < 100; ++i) {
        with_black.add(Rgb(0));
        with_black.add(Rgb(-1));
        with_black.add(Rgb(not_a_number));
    }
    CHECK(with_black.auto_ev100() == plain.auto_ev100());
}

TEST_CASE("metering does not depend on the order or the split of the pixels") {
    LuminanceHistogram forward, backward, halves[2];
    const auto light = [](uint64_t i) { return Rgb(std::exp2(20 * unit_float(hash_key(6, i)) - 10)); };
    constexpr uint64_t count = 10000;
    for (uint64_t i = 0; i < count; ++i) {
        forward.add(light(i));
        backward.add(light(count - 1 - i));
        halves[i % 2].add(light(i));
    }
    halves[1].merge(halves[0]);
    CHECK(forward.auto_ev100() == backward.auto_ev100());
    CHECK(forward.auto_ev100() == halves[1].auto_ev100());
}

TEST_CASE("automatic exposure has limits, and is 0 without light") {
    LuminanceHistogram dark, bright, empty;
    dark.add(Rgb(1e-7f));
    bright.add(Rgb(1e9f));
    empty.add(Rgb(0));
    CHECK(dark.auto_ev100() == min_auto_ev100);
    CHECK(bright.auto_ev100() == max_auto_ev100);
    CHECK(empty.auto_ev100() == 0);
}
