// libFuzzer target of the glTF reader: whatever the bytes, a scene or a refusal with exit code 3, nothing else.
// OpenImageIO 2.4 loses some bytes with each damaged PNG, so leaks are not looked for.
//   CXX=clang++-14 cmake -S . -B build-fuzz -G Ninja -DPLUVIA_FUZZ=ON && cmake --build build-fuzz --target gltf_fuzz
//   ASAN_OPTIONS=detect_leaks=0 build-fuzz/tests/fuzz/gltf_fuzz -dict=tests/fuzz/gltf.dict -max_len=4096
//     -runs=1000000 FOLDER tests/fuzz/gltf
#include "renderer/core/error.h"
#include "renderer/scene/gltf.h"

#include <unistd.h>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>

using namespace pluvia;

namespace {

/// In memory where the system has such a folder: a million files should not wait for a disk.
std::string make_folder() {
    const std::string base = std::filesystem::is_directory("/dev/shm") ? "/dev/shm" : "/tmp";
    const std::string folder = base + "/pluvia_fuzz_" + std::to_string(getpid());
    std::filesystem::create_directories(folder);
    static const std::string kept = folder;
    std::atexit([] {
        std::error_code ignored;
        std::filesystem::remove_all(kept, ignored);
    });
    return folder;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
    static const std::string folder = make_folder();
    const bool is_binary = size >= 4 && std::string(reinterpret_cast<const char*>(bytes), 4) == "glTF";
    const std::string path = folder + (is_binary ? "/scene.glb" : "/scene.gltf");
    std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(bytes), std::streamsize(size));
    try {
        const Scene scene = load_gltf(path, {.time = 0.5});
        content_hash(scene);
    } catch (const Error& e) {
        if (e.code() != ExitCode::input) {
            std::cerr << "not exit code 3: " << e.what() << "\n";
            std::abort();
        }
    }
    return 0;
}
