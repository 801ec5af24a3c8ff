// EXR files: every bit comes back, bytes do not depend on threads, half a file never looks like a whole one.
// Pictures in other formats are in image_test.cpp.
#include "renderer/image/exr.h"
#include "renderer/core/error.h"
#include "renderer/core/random.h"
#include "tests/error_of.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>

#include <sys/resource.h>
#include <unistd.h>

using namespace pluvia;

namespace {

/// A folder that goes with the test.
struct Folder {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("pluvia_exr_test_" + std::to_string(getpid()));

    Folder() { std::filesystem::create_directories(path); }
    ~Folder() { std::filesystem::remove_all(path); }
    std::string operator/(const std::string& name) const { return (path / name).string(); }
    bool is_empty() const { return std::filesystem::is_empty(path); }
};

std::string read_text(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}
void write_text(const std::string& path, const std::string& text) {
    std::ofstream(path, std::ios::binary).write(text.data(), std::streamsize(text.size()));
}

bool names(const Error& error, const std::string& path) {
    return std::string(error.what()).starts_with(path + ": ");
}

/// Two value channels and one of ids, named out of alphabetical order as callers may.
const std::vector<ExrChannel> channels = {{"rain_050.R"}, {"instance.ID", true}, {"Z"}};

struct Picture {
    int width, height;
    std::vector<float> light, depth;
    std::vector<uint32_t> ids;

    Picture(int width_, int height_) : width(width_), height(height_) {
        for (uint64_t i = 0; i < uint64_t(width) * uint64_t(height); ++i) {
            light.push_back(100 * unit_float(hash_key(1, i)));
            depth.push_back(float(i % 100));
            ids.push_back(uint32_t(hash_key(2, i / 50)));
        }
    }
    std::vector<ExrRows> rows(int y) const {
        const std::size_t first = std::size_t(y) * std::size_t(width);
        return {&light[first], &ids[first], &depth[first]};
    }
};

void write(const std::string& path, const Picture& picture, int band, const ExrAttributes& attributes = {}) {
    ExrWriter writer(path, picture.width, picture.height, channels, attributes);
    for (int y = 0; y < picture.height; y += band)
        writer.write_rows(y, std::min(band, picture.height - y), picture.rows(y));
    writer.finish();
}

}  // namespace

TEST_CASE("an EXR gives back every bit, infinity and NaN included") {
    const Folder folder;
    Picture picture(67, 45);
    const uint32_t odd_bits[] = {0x7f800000, 0xff800000, 0x7fc00000, 0xffc12345, 0x80000000, 0x00000001, 0x7f7fffff};
    for (std::size_t i = 0; i < std::size(odd_bits); ++i) picture.depth[i * 300] = std::bit_cast<float>(odd_bits[i]);
    picture.ids[7] = 0xffffffff;
    write(folder / "frame.exr", picture, 16);

    ExrReader reader(folder / "frame.exr");
    CHECK(reader.width() == 67);
    CHECK(reader.height() == 45);
    CHECK(reader.channels() == std::vector<ExrChannel>{{"Z"}, {"instance.ID", true}, {"rain_050.R"}});
    CHECK(reader.has_channel("Z"));
    CHECK_FALSE(reader.has_channel("z"));
    Picture back(67, 45);
    std::ranges::fill(back.light, 0.0f);
    std::ranges::fill(back.depth, 0.0f);
    std::ranges::fill(back.ids, 0u);
    for (int y = 0; y < 45; y += 7) {  // bands that cut the file's blocks of rows
        const std::size_t first = std::size_t(y) * 67;
        const ExrRequest requests[] = {
            {"Z", &back.depth[first]}, {"instance.ID", &back.ids[first]}, {"rain_050.R", &back.light[first]}};
        reader.read_rows(y, std::min(7, 45 - y), requests);
    }
    const auto bits = [](float v) { return std::bit_cast<uint32_t>(v); };
    CHECK(std::ranges::equal(back.depth, picture.depth, {}, bits, bits));
    CHECK(std::ranges::equal(back.light, picture.light, {}, bits, bits));
    CHECK(back.ids == picture.ids);
}

TEST_CASE("an EXR's bytes depend neither on threads nor on bands nor on the time") {
    const Folder folder;
    const Picture picture(300, 200);
    const ExrAttributes attributes = {{"pluvia/seed", 7}, {"comments", "x"}};
    write(folder / "a.exr", picture, 200, attributes);
    const std::string bytes = read_text(folder / "a.exr");
    for (const int threads : {1, 3, 0}) {
        set_exr_thread_count(threads);
        for (const int band : {1, 16, 33, 200}) {
            CAPTURE(threads);
            CAPTURE(band);
            write(folder / "b.exr", picture, band, attributes);
            CHECK(read_text(folder / "b.exr") == bytes);
        }
    }
    CHECK(bytes.find("capDate") == std::string::npos);
    CHECK(bytes.find("chromaticities") != std::string::npos);
    CHECK(bytes.find(folder.path.string()) == std::string::npos);
}

TEST_CASE("attributes come back as they were given") {
    const Folder folder;
    const ExrAttributes given = {{"pluvia/scene", "lane"},
                                 {"pluvia/seed", 123456},
                                 {"pluvia/intensity_mm_per_h", 12.5},
                                 {"expTime", 1.0f / 60},
                                 {"pluvia/wind", std::vector<float>{1, -2, 0.5f}},
                                 {"worldToCamera", std::array<float, 16>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13}}};
    write(folder / "frame.exr", Picture(32, 32), 32, given);
    const ExrAttributes back = ExrReader(folder / "frame.exr").attributes();
    for (const auto& attribute : given) {
        CAPTURE(attribute.first);
        REQUIRE(back.contains(attribute.first));
        CHECK(bool(back.at(attribute.first) == attribute.second));
    }
}

TEST_CASE("an attribute known after the rows stands in the header all the same") {
    const Folder folder;
    const Picture picture(64, 48);
    const auto write_late = [&](const std::string& path, float first, std::optional<float> late) {
        ExrWriter writer(path, 64, 48, channels, {{"pluvia/ev", first}, {"pluvia/seed", 7}});
        writer.write_rows(0, 32, picture.rows(0));
        if (late) writer.set_attribute("pluvia/ev", *late);
        writer.write_rows(32, 16, picture.rows(32));
        writer.finish();
    };
    write_late(folder / "late.exr", 0, -11.25f);
    write_late(folder / "early.exr", -11.25f, std::nullopt);
    CHECK(std::get<float>(ExrReader(folder / "late.exr").attributes().at("pluvia/ev")) == -11.25f);
    CHECK(read_text(folder / "late.exr") == read_text(folder / "early.exr"));

    ExrWriter writer(folder / "none.exr", 64, 48, channels, {{"pluvia/seed", 7}});
    CHECK(error_of([&] { writer.set_attribute("pluvia/ev", 1); }).code() == ExitCode::render_failed);
}

TEST_CASE("an EXR that is not finished leaves nothing behind") {
    const Folder folder;
    const Picture picture(64, 64);
    {
        ExrWriter writer(folder / "frame.exr", 64, 64, channels);
        writer.write_rows(0, 48, picture.rows(0));
        CHECK_FALSE(std::filesystem::exists(folder / "frame.exr"));
        CHECK_FALSE(folder.is_empty());
        const Error error = error_of([&] { writer.finish(); });
        CHECK(error.code() == ExitCode::render_failed);
        CHECK(names(error, folder / "frame.exr"));
    }
    CHECK(folder.is_empty());
}

TEST_CASE("an EXR that is not finished does not harm the one it was to replace") {
    const Folder folder;
    write(folder / "frame.exr", Picture(32, 32), 32);
    const std::string bytes = read_text(folder / "frame.exr");
    { const ExrWriter writer(folder / "frame.exr", 64, 64, channels); }
    CHECK(read_text(folder / "frame.exr") == bytes);
    write(folder / "frame.exr", Picture(64, 64), 32);
    CHECK(ExrReader(folder / "frame.exr").width() == 64);
}

TEST_CASE("rows in the wrong order, number or type are refused") {
    const Folder folder;
    const Picture picture(32, 32);
    ExrWriter writer(folder / "frame.exr", 32, 32, channels);
    const auto code_of = [&](int y, int count, const std::vector<ExrRows>& rows) {
        return error_of([&] { writer.write_rows(y, count, rows); }).code();
    };
    CHECK(code_of(16, 16, picture.rows(16)) == ExitCode::render_failed);
    CHECK(code_of(0, 33, picture.rows(0)) == ExitCode::render_failed);
    CHECK(code_of(0, 0, picture.rows(0)) == ExitCode::render_failed);
    CHECK(code_of(0, 32, {picture.light.data()}) == ExitCode::render_failed);
    CHECK(code_of(0, 32, {picture.light.data(), picture.light.data(), picture.light.data()}) ==
          ExitCode::render_failed);
    writer.write_rows(0, 32, picture.rows(0));  // a refused call changes nothing
    writer.finish();
    CHECK(ExrReader(folder / "frame.exr").height() == 32);
}

TEST_CASE("two channels of one name are refused") {
    const Folder folder;
    const Error error = error_of([&] { ExrWriter(folder / "frame.exr", 32, 32, {{"Z"}, {"N.X"}, {"Z", true}}); });
    CHECK(error.code() == ExitCode::render_failed);
    CHECK(std::string(error.what()).find("Z twice") != std::string::npos);
    CHECK(folder.is_empty());
}

TEST_CASE("a disk that is full does not give a file its final name") {
    const Folder folder;
    const Picture picture(256, 256);
    write(folder / "whole.exr", picture, 64);
    const auto whole_size = std::filesystem::file_size(folder / "whole.exr");
    rlimit before;
    getrlimit(RLIMIT_FSIZE, &before);
    const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);  // the write then fails, as on a full disk
    std::vector<ExitCode> codes;
    for (const std::uintmax_t limit : {whole_size / 2, whole_size - 1}) {
        const rlimit lowered = {rlim_t(limit), before.rlim_max};
        setrlimit(RLIMIT_FSIZE, &lowered);
        codes.push_back(error_of([&] { write(folder / "frame.exr", picture, 64); }).code());
        setrlimit(RLIMIT_FSIZE, &before);
    }
    std::signal(SIGXFSZ, old_handler);
    for (const ExitCode code : codes) CHECK(code == ExitCode::render_failed);
    CHECK_FALSE(std::filesystem::exists(folder / "frame.exr"));
    CHECK_FALSE(std::filesystem::exists(folder / "frame.tmp.exr"));
}

TEST_CASE("an EXR that cannot be read is named") {
    const Folder folder;
    write_text(folder / "text.exr", "this is not a picture");
    write_text(folder / "empty.exr", "");
    for (const char* name : {"text.exr", "empty.exr", "missing.exr"}) {
        const Error error = error_of([&] { ExrReader(folder / name); });
        CAPTURE(error.what());
        CHECK(error.code() == ExitCode::input);
        CHECK(names(error, folder / name));
    }
}

TEST_CASE("an EXR that lacks data is refused wherever it was cut") {
    const Folder folder;
    const Picture picture(64, 64);
    write(folder / "frame.exr", picture, 64);
    const std::string bytes = read_text(folder / "frame.exr");
    std::vector<float> depth(64 * 64);
    for (std::size_t size = 0; size < bytes.size(); size += 1 + std::min(size / 4, bytes.size() - 2 - size)) {
        write_text(folder / "cut.exr", bytes.substr(0, size));
        const Error error = error_of([&] {
            ExrReader reader(folder / "cut.exr");
            const ExrRequest request[] = {{"Z", depth.data()}};
            reader.read_rows(0, 64, request);
        });
        CAPTURE(size);
        CHECK(error.code() == ExitCode::input);
        CHECK(names(error, folder / "cut.exr"));
        if (size == bytes.size() - 1) break;
    }
}

TEST_CASE("what an EXR does not hold is refused") {
    const Folder folder;
    write(folder / "frame.exr", Picture(32, 32), 32);
    ExrReader reader(folder / "frame.exr");
    std::vector<float> values(32 * 32);
    const auto code_of = [&](int y, int count, const std::string& channel) {
        const ExrRequest request[] = {{channel, values.data()}};
        return error_of([&] { reader.read_rows(y, count, request); }).code();
    };
    CHECK(code_of(0, 32, "depth") == ExitCode::input);
    CHECK(code_of(0, 32, "instance.ID") == ExitCode::input);  // ids do not fit in a float
    CHECK(code_of(1, 32, "Z") == ExitCode::input);
    CHECK(code_of(-1, 2, "Z") == ExitCode::input);
    CHECK(code_of(0, 32, "Z") == ExitCode::ok);
}

TEST_CASE("an EXR may be 32768 pixels wide or high, and no more") {
    const Folder folder;
    struct Size {
        int width, height;
    };
    for (const Size size : {Size{32768, 2}, Size{2, 32768}, Size{32, 32}}) {
        CAPTURE(size.width);
        const Picture picture(size.width, size.height);
        write(folder / "frame.exr", picture, 1000);
        ExrReader reader(folder / "frame.exr");
        std::vector<float> last(static_cast<std::size_t>(size.width));
        const ExrRequest request[] = {{"rain_050.R", last.data()}};
        reader.read_rows(size.height - 1, 1, request);
        CHECK(std::ranges::equal(last, std::span(picture.light).last(std::size_t(size.width))));
    }
    for (const Size size : {Size{32769, 1}, Size{1, 32769}, Size{0, 1}, Size{1, -1}})
        CHECK(error_of([&] { ExrWriter(folder / "x.exr", size.width, size.height, channels); }).code() ==
              ExitCode::render_failed);
    CHECK_FALSE(std::filesystem::exists(folder / "x.exr"));
    const Error error = error_of([&] { ExrWriter("/proc/no/such/x.exr", 32, 32, channels); });
    CHECK(error.code() == ExitCode::render_failed);
    CHECK(names(error, "/proc/no/such/x.exr"));
}
