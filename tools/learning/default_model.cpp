#include "tools/learning/default_model.h"

#include "renderer/core/error.h"

#include <filesystem>

namespace pluvia {

std::string default_model_path() {
    namespace fs = std::filesystem;
    std::error_code error;
    const fs::path path = fs::read_symlink("/proc/self/exe", error).parent_path() / "rain.safetensors";
    if (!fs::exists(path, error)) throw input_error(path.string(), "the model that comes with Pluvia is not there");
    return path.string();
}

}  // namespace pluvia
