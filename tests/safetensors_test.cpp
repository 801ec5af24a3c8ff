// The reader and writer of weights: what is written comes back, what is damaged is refused with exit code 3.
#include "tools/learning/safetensors.h"
#include "renderer/core/error.h"
#include "tests/temporary_folder.h"

#include <doctest/doctest.h>

#include <sys/resource.h>
#include <cmath>
#include <cstring>

using namespace pluvia;

namespace {

std::vector<float> read_all(SafetensorsFile& file, const std::string& name) {
    std::vector<float> values(size_t(element_count(file.entries().at(name).shape)));
    file.read(name, values);
    return values;
}

/// A file of that header and so many bytes of data.
std::string file_with(const std::string& header, size_t data_bytes) {
    const uint64_t length = header.size();
    std::string bytes(8, '\0');
    std::memcpy(bytes.data(), &length, 8);
    return bytes + header + std::string(data_bytes, '\0');
}

ExitCode exit_code_of(const auto& action) {
    try {
        action();
    } catch (const Error& e) {
        return e.code();
    }
    return ExitCode::ok;
}

}  // namespace

TEST_CASE("written weights come back, in half precision rounded") {
    const TemporaryFolder folder;
    const std::vector<float> a = {1, -2.5f, 3e-5f, 65504, 0.1f, 0}, b = {7};
    write_safetensors(folder / "f32", {{"pluvia", "{}"}}, {{"a", {2, 3}, a}, {"b", {}, b}});
    SafetensorsFile whole(folder / "f32");
    CHECK(whole.metadata().at("pluvia") == "{}");
    CHECK(whole.entries().at("a").shape == TensorShape{2, 3});
    CHECK(read_all(whole, "a") == a);
    CHECK(read_all(whole, "b") == b);
    write_safetensors(folder / "f16", {}, {{"a", {2, 3}, a}}, TensorType::f16);
    SafetensorsFile halved(folder / "f16");
    const std::vector<float> read = read_all(halved, "a");
    for (size_t i = 0; i < a.size(); ++i)  // 11 bits; below 2^-14 in steps of 2^-24
        CHECK(std::abs(read[i] - a[i]) <= std::max(std::abs(a[i]) * 0x1p-11f, 0x1p-25f));
}

TEST_CASE("every half comes back from float, and floats go to the nearest, even on ties") {
    for (uint32_t h = 0; h < 65536; ++h) {
        const float value = float_from_half(uint16_t(h));
        if (std::isnan(value)) continue;
        REQUIRE(half_from_float(value) == h);
        const uint32_t magnitude = h & 0x7fff;
        if (magnitude >= 0x7bff) continue;
        const float next = float_from_half(uint16_t(h + 1)), middle = (value + next) / 2;
        REQUIRE(half_from_float(middle) == (h % 2 == 0 ? h : h + 1));
    }
    CHECK(half_from_float(65520) == 0x7c00);  // halfway beyond the largest
    CHECK(half_from_float(65519) == 0x7bff);
    CHECK(std::isnan(float_from_half(half_from_float(NAN))));
}

TEST_CASE("every file of the corpus of weights is read or refused with exit code 3, as its name says") {
    int read = 0, refused = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::string(PLUVIA_SOURCE_DIR) + "/tests/fuzz/safetensors")) {
        const std::string path = entry.path().string();
        CAPTURE(path);
        const ExitCode code = exit_code_of([&] {
            SafetensorsFile file(path);
            for (const auto& [name, tensor] : file.entries())
                if (tensor.type <= TensorType::bf16) read_all(file, name);
        });
        const bool to_refuse = entry.path().filename().string().starts_with("refused_");
        CHECK(code == (to_refuse ? ExitCode::input : ExitCode::ok));
        ++(to_refuse ? refused : read);
    }
    CHECK(read >= 4);
    CHECK(refused >= 20);
}

TEST_CASE("a weight file cut at any byte is refused") {
    const TemporaryFolder folder;
    const std::vector<float> values = {1, 2, 3};
    write_safetensors(folder / "whole", {}, {{"a", {3}, values}});
    const std::string bytes = read_file(folder / "whole");
    for (size_t n = 0; n < bytes.size(); ++n) {
        write_file(folder / "cut", bytes.substr(0, n));
        CAPTURE(n);
        CHECK(exit_code_of([&] { SafetensorsFile file(folder / "cut"); }) == ExitCode::input);
    }
}

TEST_CASE("a header that lies about sizes costs no memory") {
    const TemporaryFolder folder;
    rusage before, after;
    getrusage(RUSAGE_SELF, &before);
    for (const char* shape : {"[1099511627776]", "[1048576,1048576,4]", "[9223372036854775807]"}) {
        write_file(folder / "huge", file_with(std::string(R"({"a":{"dtype":"F32","shape":)") + shape +
                                                  R"(,"data_offsets":[0,4398046511104]}})",
                                              16));
        CHECK(exit_code_of([&] { SafetensorsFile file(folder / "huge"); }) == ExitCode::input);
    }
    // A header of its largest size, made of as many values as possible.
    std::string header = R"({"a":[)";
    while (header.size() < (4 << 20) - 8) header += "0,";
    write_file(folder / "many", file_with(header + "0]}", 0));
    CHECK(exit_code_of([&] { SafetensorsFile file(folder / "many"); }) == ExitCode::input);
    getrusage(RUSAGE_SELF, &after);
    CHECK(after.ru_maxrss - before.ru_maxrss < 128 * 1024);  // KiB
}

TEST_CASE("integers and missing tensors are refused where floats are asked for") {
    SafetensorsFile file(std::string(PLUVIA_SOURCE_DIR) + "/tests/fuzz/safetensors/mixed.safetensors");
    std::vector<float> one(1);
    CHECK(exit_code_of([&] { file.read("i", one); }) == ExitCode::input);
    CHECK(exit_code_of([&] { file.read("none", one); }) == ExitCode::input);
    file.read("s", one);
    CHECK(one[0] == 2.5f);
}
