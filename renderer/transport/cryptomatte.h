// Cryptomatte: which objects and materials a pixel's samples show and how much of each, so that compositing programs
// cut them out with soft edges. Of the clean picture; the rain's own matte is a layer for each intensity, its coverage.
// Source: Friedman and Jones 2015, "Fully automatic ID mattes with support for motion blur and transparency"; names and
// attributes by the Cryptomatte specification 1.2.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pluvia {

/// MurmurHash3_x86_32 with seed 0 (Appleby 2011, public domain).
uint32_t murmur_hash(std::string_view text);
/// The id of a name as a finite float: the hash's bits, its exponent kept from 0 and 255.
float cryptomatte_id(std::string_view name);

/// Names that are not among them share their id with none.
constexpr int cryptomatte_ranks = 6;  // of the most covering names of a pixel
constexpr int cryptomatte_channels = 2 * cryptomatte_ranks;

/// "CryptoObject00.R", ...: id and coverage of rank 0, 1, ...; cryptomatte_channels of them.
std::vector<std::string> cryptomatte_channel_names(const std::string& layer);
/// Of the rain at an intensity: id and coverage of the one name "rain".
std::vector<std::string> rain_matte_channel_names(const std::string& intensity_label);
std::string rain_matte_layer(const std::string& intensity_label);

/// Header entries of a layer, keys and values: its names with their ids.
std::map<std::string, std::string> cryptomatte_header(const std::string& layer, const std::vector<std::string>& names);

/// Counts of one pixel: which of the indices samples have shown.
class MatteCounts {
public:
    void clear() { counts_.clear(); }
    void add(int index);
    /// ids: of the indices. values: cryptomatte_channels of them, ranks in falling order of coverage.
    void write(const std::vector<float>& ids, int samples, float* values);

private:
    std::vector<std::pair<int, int>> counts_;  // index, count: few, in no order
};

}  // namespace pluvia
