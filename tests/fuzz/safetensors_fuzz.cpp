// libFuzzer target of the reader of weights: whatever the bytes, tensors or a refusal with exit code 3, nothing else.
//   CXX=clang++-14 cmake -S . -B build-fuzz -G Ninja -DPLUVIA_FUZZ=ON
//   cmake --build build-fuzz --target safetensors_fuzz
// No input of 4 kB may ask for as much as 64 MB at once:
//   build-fuzz/tests/fuzz/safetensors_fuzz -malloc_limit_mb=64 -dict=tests/fuzz/safetensors.dict -max_len=4096
//     -runs=1000000 FOLDER tests/fuzz/safetensors
#include "renderer/core/error.h"
#include "tests/fuzz/memory_file.h"
#include "tools/learning/crig_config.h"
#include "tools/learning/model_config.h"

#include <cstdlib>
#include <iostream>
#include <string>

using namespace pluvia;

namespace {

/// Lets only refusals with exit code 3 pass.
template <class Action>
void expect_refusal_or_success(const Action& action) {
    try {
        action();
    } catch (const Error& e) {
        if (e.code() == ExitCode::input) return;
        std::cerr << "not exit code 3: " << e.what() << "\n";
        std::abort();
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
    static const MemoryFile memory("model.safetensors");
    memory.write(bytes, size);
    const std::string& path = memory.path;
    expect_refusal_or_success([&] {
        SafetensorsFile file(path);
        for (const auto& tensor : file.entries())
            expect_refusal_or_success([&] {
                const TensorEntry& entry = tensor.second;
                std::vector<float> values(entry.type <= TensorType::bf16 ? size_t(element_count(entry.shape)) : 0);
                file.read(tensor.first, values);
            });
        expect_refusal_or_success([&] { model_config(file); });
        expect_refusal_or_success([&] { crig_config(file); });
        const TensorShapes shapes = shapes_below(file.entries(), "");
        expect_refusal_or_success([&] { unet_config(shapes, 32, path); });
        expect_refusal_or_success([&] { first_stage_config(shapes, path); });
    });
    return 0;
}
