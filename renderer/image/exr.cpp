#include "renderer/image/exr.h"

#include "renderer/core/error.h"
#include "renderer/image/pending_file.h"

#include <ImfChannelList.h>
#include <ImfDoubleAttribute.h>
#include <ImfFloatAttribute.h>
#include <ImfFloatVectorAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfIntAttribute.h>
#include <ImfMatrixAttribute.h>
#include <ImfOutputFile.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfTestFile.h>
#include <ImfThreading.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>

namespace pluvia {
namespace {

constexpr int max_side = 32768;

// Measured on one core, 2048 x 1024 floats with 15 % noise and on depth, masks and sparse light:
// ZIP 3: 44 MB/s, ratio 1.04 and 370 MB/s, 32; ZIP 6: 41, 1.04 and 187, 38; ZIP 9: 41, 1.04 and 29, 40;
// ZIPS 1: 67, 1.01 and 305, 16; PIZ: 43, 1.14 and 220, 9; RLE: 447, 1.00 and 561, 2.
constexpr int zip_level = 3;

using Matrix = std::array<float, 16>;  // Imath's M44f is an array of rows too

struct AttributeInserter {
    Imf::Header& header;
    const char* name;

    void operator()(const std::string& v) const { header.insert(name, Imf::StringAttribute(v)); }
    void operator()(double v) const { header.insert(name, Imf::DoubleAttribute(v)); }
    void operator()(float v) const { header.insert(name, Imf::FloatAttribute(v)); }
    void operator()(int v) const { header.insert(name, Imf::IntAttribute(v)); }
    void operator()(const std::vector<float>& v) const { header.insert(name, Imf::FloatVectorAttribute(v)); }
    void operator()(const Matrix& v) const {
        Imath::M44f m;
        std::copy(v.begin(), v.end(), m.getValue());
        header.insert(name, Imf::M44fAttribute(m));
    }
};

std::optional<ExrAttribute> attribute_value(const Imf::Attribute& attribute) {
    if (const auto* s = dynamic_cast<const Imf::StringAttribute*>(&attribute)) return s->value();
    if (const auto* d = dynamic_cast<const Imf::DoubleAttribute*>(&attribute)) return d->value();
    if (const auto* f = dynamic_cast<const Imf::FloatAttribute*>(&attribute)) return f->value();
    if (const auto* i = dynamic_cast<const Imf::IntAttribute*>(&attribute)) return i->value();
    if (const auto* v = dynamic_cast<const Imf::FloatVectorAttribute*>(&attribute)) return v->value();
    if (const auto* m = dynamic_cast<const Imf::M44fAttribute*>(&attribute)) {
        Matrix values;
        std::copy_n(m->value().getValue(), values.size(), values.begin());
        return values;
    }
    return std::nullopt;
}

/// The library would open the file itself, close it in a destructor and swallow the error of a full disk.
class Stream : public Imf::OStream {
public:
    explicit Stream(std::ofstream& file) : OStream("EXR"), file_(file) {}

    void write(const char bytes[], int count) override {
        if (!file_.write(bytes, count)) throw std::runtime_error("the disk may be full");
        if (in_header_) header_.append(bytes, size_t(count));
    }
    uint64_t tellp() override { return uint64_t(std::streamoff(file_.tellp())); }
    void seekp(uint64_t position) override { file_.seekp(std::streamoff(position)); }

    void end_header() { in_header_ = false; }
    /// The bytes at the beginning of the file, up to end_header().
    const std::string& header() const { return header_; }

private:
    std::ofstream& file_;
    std::string header_;
    bool in_header_ = true;
};

Imf::PixelType pixel_type(bool is_id) {
    return is_id ? Imf::UINT : Imf::FLOAT;
}

template <class Rows>
bool holds_ids(const Rows& rows) {
    return rows.index() == 1;
}

template <class Rows>
Imf::Slice band_slice(const Rows& rows, const Imath::Box2i& band) {
    const void* first = std::visit([](auto* pointer) -> const void* { return pointer; }, rows);
    return Imf::Slice::Make(pixel_type(holds_ids(rows)), first, band);
}

}  // namespace

void set_exr_thread_count(int threads) {
    Imf::setGlobalThreadCount(threads);
}

bool is_exr(const std::string& path) {
    return Imf::isOpenExrFile(path.c_str());
}

// ---- writing

struct ExrWriter::State {
    PendingFile pending;
    int width, height;
    std::vector<ExrChannel> channels;
    int next_row = 0;
    Stream stream;
    std::optional<Imf::OutputFile> file;

    State(const std::string& path, int width_, int height_, std::vector<ExrChannel> channels_)
        : pending(path), width(width_), height(height_), channels(std::move(channels_)), stream(pending.stream()) {}
};

ExrWriter::ExrWriter(const std::string& path, int width, int height, std::vector<ExrChannel> channels,
                     const ExrAttributes& attributes)
    : state_(std::make_unique<State>(path, width, height, std::move(channels))) {
    State& s = *state_;
    if (width < 1 || height < 1 || width > max_side || height > max_side)
        throw s.pending.write_error("got a size of " + std::to_string(width) + " x " + std::to_string(height) +
                                    ", expected 1 to 32768");
    try {
        Imf::Header header(width, height);
        header.compression() = Imf::ZIP_COMPRESSION;
        header.zipCompressionLevel() = zip_level;
        Imf::addChromaticities(header, Imf::Chromaticities());  // the library's default is Rec.709 with D65
        for (const auto& [name, value] : attributes) std::visit(AttributeInserter{header, name.c_str()}, value);
        for (const ExrChannel& c : s.channels) {
            if (header.channels().findChannel(c.name)) throw std::invalid_argument("got channel " + c.name + " twice");
            header.channels().insert(c.name, Imf::Channel(pixel_type(c.is_id)));
        }
        s.file.emplace(s.stream, header, Imf::globalThreadCount());
        s.stream.end_header();
    } catch (const std::exception& e) {
        throw s.pending.write_error(e.what());
    }
}

ExrWriter::~ExrWriter() = default;

void ExrWriter::write_rows(int y, int count, std::span<const ExrRows> channels) {
    State& s = *state_;
    if (y != s.next_row || count < 1 || count > s.height - y || channels.size() != s.channels.size())
        throw s.pending.write_error("got " + std::to_string(count) + " rows of " + std::to_string(channels.size()) +
                                    " channels at row " + std::to_string(y) + ", expected " +
                                    std::to_string(s.channels.size()) + " channels at row " +
                                    std::to_string(s.next_row) + " of " + std::to_string(s.height));
    const Imath::Box2i band({0, y}, {s.width - 1, y + count - 1});
    Imf::FrameBuffer rows;
    for (std::size_t i = 0; i < channels.size(); ++i) {
        if (holds_ids(channels[i]) != s.channels[i].is_id)
            throw s.pending.write_error("channel " + s.channels[i].name + " got the wrong type of rows");
        rows.insert(s.channels[i].name, band_slice(channels[i], band));
    }
    try {
        s.file->setFrameBuffer(rows);
        s.file->writePixels(count);
    } catch (const std::exception& e) {
        throw s.pending.write_error(e.what());
    }
    s.next_row += count;
}

void ExrWriter::set_attribute(const std::string& name, float value) {
    // The library writes the header once. In the file an attribute is its name, its type, its size and its value,
    // numbers little-endian (OpenEXR, "OpenEXR File Layout").
    State& s = *state_;
    std::string entry = name;
    entry += '\0';
    entry += "float";
    entry += '\0';
    entry += std::string("\4\0\0\0", 4);
    const auto found = s.stream.header().find(entry);
    if (found == std::string::npos) throw s.pending.write_error("it has no float attribute " + name);
    const auto bits = std::bit_cast<uint32_t>(value);
    char bytes[4];
    for (int i = 0; i < 4; ++i) bytes[i] = char(bits >> (8 * i));
    const uint64_t end = s.stream.tellp();
    s.stream.seekp(found + entry.size());
    try {
        s.stream.write(bytes, 4);
    } catch (const std::exception& e) {
        throw s.pending.write_error(e.what());
    }
    s.stream.seekp(end);
}

void ExrWriter::finish() {
    State& s = *state_;
    if (s.next_row != s.height)
        throw s.pending.write_error("got " + std::to_string(s.next_row) + " rows, expected " +
                                    std::to_string(s.height));
    s.file.reset();  // writes the table of offsets
    s.pending.commit();
}

// ---- reading

struct ExrReader::State {
    std::string path;
    std::optional<Imf::InputFile> file;
    Imath::Box2i window;
    std::vector<ExrChannel> channels;
    ExrAttributes attributes;

    int width() const { return window.max.x - window.min.x + 1; }
    int height() const { return window.max.y - window.min.y + 1; }
};

ExrReader::ExrReader(const std::string& path) : state_(std::make_unique<State>()) {
    State& s = *state_;
    s.path = path;
    if (std::ifstream file(path, std::ios::binary); !file)
        throw input_error(path, std::string("cannot be opened (") + std::strerror(errno) + ")");
    if (!is_exr(path)) throw input_error(path, "is not an EXR file");
    try {
        s.file.emplace(path.c_str(), Imf::globalThreadCount());
    } catch (const std::exception& e) {
        throw input_error(path, std::string("cannot be read (") + e.what() + ")");
    }
    const Imf::Header& header = s.file->header();
    if (header.hasType() && Imf::isDeepData(header.type())) throw input_error(path, "holds deep data (expected flat)");
    s.window = header.dataWindow();
    if (s.width() > max_side || s.height() > max_side)
        throw input_error(path, "is too large (got " + std::to_string(s.width()) + " x " + std::to_string(s.height()) +
                                    ", expected up to 32768 x 32768)");
    if (!s.file->isComplete()) throw input_error(path, "is truncated: its table of rows is not complete");
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
        if (c.channel().xSampling != 1 || c.channel().ySampling != 1)
            throw input_error(path, std::string("channel ") + c.name() + " is subsampled (expected one value a pixel)");
        s.channels.push_back({c.name(), c.channel().type == Imf::UINT});
    }
    for (auto a = header.begin(); a != header.end(); ++a)
        if (auto value = attribute_value(a.attribute())) s.attributes.emplace(a.name(), *std::move(value));
}

ExrReader::~ExrReader() = default;

int ExrReader::width() const {
    return state_->width();
}
int ExrReader::height() const {
    return state_->height();
}
const std::vector<ExrChannel>& ExrReader::channels() const {
    return state_->channels;
}
const ExrAttributes& ExrReader::attributes() const {
    return state_->attributes;
}

bool ExrReader::has_channel(const std::string& name) const {
    return std::ranges::find(state_->channels, name, &ExrChannel::name) != state_->channels.end();
}

void ExrReader::read_rows(int y, int count, std::span<const ExrRequest> requests) {
    State& s = *state_;
    if (y < 0 || count < 1 || count > s.height() - y)
        throw input_error(s.path, "has no rows " + std::to_string(y) + " to " + std::to_string(y + count - 1) +
                                      " (got a height of " + std::to_string(s.height()) + ")");
    const Imath::Box2i band({s.window.min.x, s.window.min.y + y}, {s.window.max.x, s.window.min.y + y + count - 1});
    Imf::FrameBuffer rows;
    for (const ExrRequest& request : requests) {
        const auto channel = std::ranges::find(s.channels, request.channel, &ExrChannel::name);
        if (channel == s.channels.end()) throw input_error(s.path, "has no channel " + request.channel);
        if (channel->is_id != holds_ids(request.rows))
            throw input_error(s.path, "channel " + request.channel + " has the wrong type (got " +
                                          (channel->is_id ? "ids, expected values)" : "values, expected ids)"));
        rows.insert(request.channel, band_slice(request.rows, band));
    }
    try {
        s.file->setFrameBuffer(rows);
        s.file->readPixels(band.min.y, band.max.y);
    } catch (const std::exception& e) {
        throw input_error(s.path, std::string("is truncated or damaged (") + e.what() + ")");
    }
}

}  // namespace pluvia
