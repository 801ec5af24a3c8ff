// libFuzzer target of the glTF reader: whatever the bytes, a scene or a refusal with exit code 3, nothing else.
// OpenImageIO 2.4 loses some bytes with each damaged PNG, so leaks are not looked for.
//   CXX=clang++-14 cmake -S . -B build-fuzz -G Ninja -DPLUVIA_FUZZ=ON && cmake --build build-fuzz --target gltf_fuzz
//   ASAN_OPTIONS=detect_leaks=0 build-fuzz/tests/fuzz/gltf_fuzz -dict=tests/fuzz/gltf.dict -max_len=4096
//     -runs=1000000 FOLDER tests/fuzz/gltf
#include "renderer/core/error.h"
#include "renderer/scene/gltf.h"
#include "tests/fuzz/memory_file.h"

#include <cstdlib>
#include <iostream>
#include <string>

using namespace pluvia;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
    static const MemoryFile text("scene.gltf"), binary("scene.glb");
    const bool is_binary = size >= 4 && std::string(reinterpret_cast<const char*>(bytes), 4) == "glTF";
    const MemoryFile& file = is_binary ? binary : text;
    file.write(bytes, size);
    try {
        const Scene scene = load_gltf(file.path, {.time = 0.5});
        content_hash(scene);
    } catch (const Error& e) {
        if (e.code() != ExitCode::input) {
            std::cerr << "not exit code 3: " << e.what() << "\n";
            std::abort();
        }
    }
    return 0;
}
