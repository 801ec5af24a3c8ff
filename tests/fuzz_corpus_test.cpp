// Every file of the fuzzing corpus is read or refused with exit code 3, in the normal build too; what a long run finds
// is kept there.
#include "renderer/core/error.h"
#include "renderer/scene/gltf.h"
#include "tests/temporary_folder.h"

#include <doctest/doctest.h>

using namespace pluvia;

TEST_CASE("every file of the fuzzing corpus is read or refused, never more") {
    const TemporaryFolder folder;
    int read = 0, refused = 0;
    for (const auto& entry : std::filesystem::directory_iterator(std::string(PLUVIA_SOURCE_DIR) + "/tests/fuzz/gltf")) {
        const std::string bytes = read_file(entry.path().string());
        // As the fuzzer does: names say what a file is for, not how it is read.
        const std::string path = folder / (bytes.starts_with("glTF") ? "scene.glb" : "scene.gltf");
        write_file(path, bytes);
        CAPTURE(entry.path().string());
        try {
            load_gltf(path, {.time = 0.5});
            ++read;
        } catch (const Error& e) {
            CHECK(e.code() == ExitCode::input);
            ++refused;
        }
    }
    CHECK(read >= 10);
    CHECK(refused >= 1);
}
