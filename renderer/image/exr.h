// EXR files of named float and id channels, written and read in bands of rows; the OpenEXR door.
// Which channels a frame has is decided where frames are written; here a name is only a name.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace pluvia {

struct ExrChannel {
    std::string name;    // "background.R", "Z"
    bool is_id = false;  // stored as UINT, otherwise as FLOAT

    friend bool operator==(const ExrChannel&, const ExrChannel&) = default;
};

/// Header entries; OpenEXR's standard ones (expTime, isoSpeed, latitude, ...) are float. The array is a 4x4 matrix,
/// row-major, for row vectors as OpenEXR has it: translation in its last row.
using ExrAttribute = std::variant<std::string, double, float, int, std::vector<float>, std::array<float, 16>>;
using ExrAttributes = std::map<std::string, ExrAttribute>;

/// Rows of one channel, tightly packed: float for values, uint32_t for ids.
using ExrRows = std::variant<const float*, const uint32_t*>;
using ExrRowsOut = std::variant<float*, uint32_t*>;

/// Threads that compress and decompress beside the caller, for all files; 0 = in the caller. The bytes do not depend
/// on it. Call once, while no EXR file is open.
void set_exr_thread_count(int threads);

/// A scanline file with lossless ZIP compression and Rec.709 chromaticities, written under a temporary name.
/// The same rows and attributes give the same bytes. Throws Error (render_failed) when the file cannot be written.
class ExrWriter {
public:
    /// width, height: 1 to 32768. Channel names are unique and not empty.
    ExrWriter(const std::string& path, int width, int height, std::vector<ExrChannel> channels,
              const ExrAttributes& attributes = {});
    /// Removes the temporary file when finish() was not reached.
    ~ExrWriter();

    /// Rows y to y + count - 1 of every channel, in the order given to the constructor; y continues where the last
    /// call ended. Bands of a multiple of 16 rows are compressed without being copied and in parallel.
    void write_rows(int y, int count, std::span<const ExrRows> channels);

    /// Replaces the value of a float attribute that the constructor was given; also when rows are written already, for
    /// what is known only then.
    void set_attribute(const std::string& name, float value);

    /// Gives the file its final name once all rows are written.
    void finish();

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Whether a readable file begins as EXR files do.
bool is_exr(const std::string& path);

/// One channel to read and where its rows go.
struct ExrRequest {
    std::string channel;
    ExrRowsOut rows;
};

/// Reads bands of an EXR file; the first part of several. Memory is bounded by the band.
/// Throws Error (input) with the file when it is missing, not an EXR, deep, subsampled, too large or truncated.
class ExrReader {
public:
    explicit ExrReader(const std::string& path);
    ~ExrReader();

    int width() const;
    int height() const;
    /// In the file's order, which is alphabetical. HALF channels count as float.
    const std::vector<ExrChannel>& channels() const;
    bool has_channel(const std::string& name) const;
    /// Those that have one of the types of ExrAttribute.
    const ExrAttributes& attributes() const;

    /// Rows y to y + count - 1, counted from the top of the data window, of all channels asked for in one pass.
    /// A request's pointer must be float for values and uint32_t for ids, with room for width() * count.
    void read_rows(int y, int count, std::span<const ExrRequest> requests);

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace pluvia
