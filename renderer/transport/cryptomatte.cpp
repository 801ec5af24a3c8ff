#include "renderer/transport/cryptomatte.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>

namespace pluvia {

uint32_t murmur_hash(std::string_view text) {
    constexpr uint32_t c1 = 0xcc9e2d51, c2 = 0x1b873593;
    const auto scramble = [](uint32_t k) { return std::rotl(k * c1, 15) * c2; };
    const auto byte = [&](size_t i) { return uint32_t(static_cast<unsigned char>(text[i])); };
    uint32_t h = 0;
    const size_t blocks = text.size() / 4;
    for (size_t i = 0; i < 4 * blocks; i += 4) {
        h ^= scramble(byte(i) | byte(i + 1) << 8 | byte(i + 2) << 16 | byte(i + 3) << 24);
        h = std::rotl(h, 13) * 5 + 0xe6546b64;
    }
    uint32_t tail = 0;
    for (size_t i = text.size(); i > 4 * blocks; --i) tail = tail << 8 | byte(i - 1);
    h ^= scramble(tail);
    h ^= uint32_t(text.size());
    h = (h ^ h >> 16) * 0x85ebca6b;
    h = (h ^ h >> 13) * 0xc2b2ae35;
    return h ^ h >> 16;
}

float cryptomatte_id(std::string_view name) {
    uint32_t bits = murmur_hash(name);
    const uint32_t exponent = bits >> 23 & 255;
    if (exponent == 0 || exponent == 255) bits ^= 1 << 23;  // neither denormal, infinite nor NaN
    return std::bit_cast<float>(bits);
}

std::vector<std::string> cryptomatte_channel_names(const std::string& layer) {
    std::vector<std::string> names;
    for (int level = 0; level < cryptomatte_ranks / 2; ++level)
        for (const char* channel : {"R", "G", "B", "A"})
            names.push_back(fmt::format("{}{:02}.{}", layer, level, channel));
    return names;
}

std::string rain_matte_layer(const std::string& intensity_label) {
    return "CryptoRain_" + intensity_label + "_";
}

std::vector<std::string> rain_matte_channel_names(const std::string& intensity_label) {
    const std::string layer = rain_matte_layer(intensity_label);
    return {layer + "00.R", layer + "00.G", layer + "00.B", layer + "00.A"};
}

std::map<std::string, std::string> cryptomatte_header(const std::string& layer, const std::vector<std::string>& names) {
    nlohmann::json manifest = nlohmann::json::object();
    for (const std::string& name : names)
        manifest[name] = fmt::format("{:08x}", std::bit_cast<uint32_t>(cryptomatte_id(name)));
    const std::string key = "cryptomatte/" + fmt::format("{:08x}", murmur_hash(layer)).substr(0, 7) + "/";
    return {{key + "name", layer},
            {key + "hash", "MurmurHash3_32"},
            {key + "conversion", "uint32_to_float32"},
            {key + "manifest", manifest.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace)}};
}

void MatteCounts::add(int index) {
    for (auto& [known, count] : counts_)
        if (known == index) {
            ++count;
            return;
        }
    counts_.emplace_back(index, 1);
}

void MatteCounts::write(const std::vector<float>& ids, int samples, float* values) {
    std::sort(counts_.begin(), counts_.end(), [](const auto& a, const auto& b) {
        return a.second != b.second ? a.second > b.second : a.first < b.first;
    });
    for (size_t rank = 0; rank < size_t(cryptomatte_ranks); ++rank) {
        const bool taken = rank < counts_.size();
        *values++ = taken ? ids[size_t(counts_[rank].first)] : 0.0f;
        *values++ = taken ? float(counts_[rank].second) / float(samples) : 0.0f;
    }
}

}  // namespace pluvia
