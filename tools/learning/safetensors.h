// Weights in files of the .safetensors format: a header in JSON, then raw tensors.
// Nothing is believed before it is checked: a damaged or hostile file ends in an Error and costs no more memory than
// its header has bytes. Source of the format: Hugging Face, "Safetensors" (format section of its README).
#pragma once

#include <cstdint>
#include <fstream>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace pluvia {

enum class TensorType { f64, f32, f16, bf16, i64, i32, i16, i8, u8, boolean };
/// As the format spells it: F64, F32, ...
const char* tensor_type_name(TensorType type);

using TensorShape = std::vector<int64_t>;
/// Product of the sides; 1 for a scalar.
int64_t element_count(const TensorShape& shape);
/// "[3, 128, 128]"
std::string shape_text(const TensorShape& shape);

struct TensorEntry {
    TensorType type = TensorType::f32;
    TensorShape shape;
    uint64_t offset = 0, bytes = 0;  // within the file
};

/// An open file whose header has been checked: every tensor lies inside of the file, has the size that its shape and
/// type ask for, and shares no byte with another.
class SafetensorsFile {
public:
    /// Throws Error (input) naming the tensor at fault.
    explicit SafetensorsFile(const std::string& path);

    const std::string& path() const { return path_; }
    const std::map<std::string, TensorEntry>& entries() const { return entries_; }
    const std::map<std::string, std::string>& metadata() const { return metadata_; }
    bool has(const std::string& name) const { return entries_.count(name) != 0; }

    /// Values of a tensor of floats in any precision, row-major. values must have its element count.
    /// Throws Error (input) when there is no such tensor, it holds integers or a value that is not finite.
    void read(const std::string& name, std::span<float> values);

private:
    std::string path_;
    std::ifstream stream_;
    std::map<std::string, TensorEntry> entries_;
    std::map<std::string, std::string> metadata_;
};

struct WrittenTensor {
    std::string name;
    TensorShape shape;
    std::span<const float> values;
};

/// Writes F32, or F16 rounded to nearest even, in the order given. The file appears whole.
/// Throws Error (render_failed) when it cannot be written.
void write_safetensors(const std::string& path, const std::map<std::string, std::string>& metadata,
                       const std::vector<WrittenTensor>& tensors, TensorType type = TensorType::f32);

/// IEEE 754 binary16; subnormals, infinities and NaN included.
float float_from_half(uint16_t half);
uint16_t half_from_float(float value);

}  // namespace pluvia
