// Every file of the fuzzing corpora, and what a few thousand changes of bytes make of them, is read or refused with its
// exit code, in the normal build too; what a long run of tests/fuzz finds is kept there.
#include "renderer/core/error.h"
#include "renderer/core/random.h"
#include "renderer/scene/gltf.h"
#include "tests/temporary_folder.h"
#include "tools/dataset/config.h"
#include "tools/label_rules.h"

#include <doctest/doctest.h>

#include <functional>
#include <vector>

using namespace pluvia;

namespace {

std::vector<std::string> corpus(const std::string& name) {
    std::vector<std::string> paths;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::string(PLUVIA_SOURCE_DIR) + "/tests/fuzz/" + name))
        paths.push_back(entry.path().string());
    std::sort(paths.begin(), paths.end());
    return paths;
}

/// One to four bytes changed, dropped or repeated.
std::string mutated(std::string bytes, uint64_t seed) {
    const uint64_t changes = 1 + hash_key(seed, 0) % 4;
    for (uint64_t i = 1; i <= changes && !bytes.empty(); ++i) {
        const uint64_t random = hash_key(seed, i);
        const size_t place = size_t(random >> 16) % bytes.size(), length = std::min<size_t>(8, bytes.size() - place);
        switch (random % 4) {
            case 0:
                bytes[place] = char(random >> 8);
                break;
            case 1:
                bytes[place] = "0123456789-.eE{}[]\":,*&"[(random >> 8) % 23];
                break;
            case 2:
                bytes.erase(place, length);
                break;
            default:
                bytes.insert(place, bytes.substr(place, length));
        }
    }
    return bytes;
}

struct Outcomes {
    int read = 0, refused = 0;
};

/// `read` throws Error with one of these exit codes, or nothing.
void run(Outcomes& outcomes, const std::function<void()>& read, std::initializer_list<ExitCode> expected) {
    try {
        read();
        ++outcomes.read;
    } catch (const Error& e) {
        CAPTURE(e.what());
        CHECK(std::find(expected.begin(), expected.end(), e.code()) != expected.end());
        CHECK(std::string(e.what()).find('\n') == std::string::npos);
        ++outcomes.refused;
    }
}

void read_as_gltf(const TemporaryFolder& folder, const std::string& bytes, Outcomes& outcomes) {
    // As the fuzzer does: names say what a file is for, not how it is read.
    const std::string path = folder / (bytes.starts_with("glTF") ? "scene.glb" : "scene.gltf");
    write_file(path, bytes);
    run(outcomes, [&] { load_gltf(path, {.time = 0.5}); }, {ExitCode::input});
}

void read_as_config(const TemporaryFolder& folder, const std::string& bytes, Outcomes& outcomes) {
    const std::string path = folder / "dataset.yaml";
    write_file(path, bytes);
    run(outcomes, [&] { read_label_rules(path); }, {ExitCode::input, ExitCode::usage});
    run(outcomes, [&] { read_dataset_config(path); }, {ExitCode::input, ExitCode::usage});
}

}  // namespace

TEST_CASE("every glTF file of the fuzzing corpus is read or refused, never more") {
    const TemporaryFolder folder;
    Outcomes outcomes;
    for (const std::string& path : corpus("gltf")) {
        CAPTURE(path);
        read_as_gltf(folder, read_file(path), outcomes);
    }
    CHECK(outcomes.read >= 10);
    CHECK(outcomes.refused >= 1);
}

TEST_CASE("changed bytes in a glTF file are read or refused with one line") {
    const TemporaryFolder folder;
    Outcomes outcomes;
    for (const std::string& path : corpus("gltf"))
        for (uint64_t seed = 0; seed < 100; ++seed) {
            CAPTURE(path);
            CAPTURE(seed);
            read_as_gltf(folder, mutated(read_file(path), seed), outcomes);
        }
    CHECK(outcomes.read >= 100);
    CHECK(outcomes.refused >= 100);
}

TEST_CASE("every YAML file of the fuzzing corpus and changes of it are read or refused with one line") {
    const TemporaryFolder folder;
    Outcomes outcomes;
    for (const std::string& path : corpus("config"))
        for (uint64_t seed = 0; seed < 20; ++seed) {
            CAPTURE(path);
            CAPTURE(seed);
            read_as_config(folder, seed == 0 ? read_file(path) : mutated(read_file(path), seed), outcomes);
        }
    CHECK(outcomes.read >= 3);
    CHECK(outcomes.refused >= 20);
}

TEST_CASE("YAML that repeats itself without end, or ten to the eighth times, is refused with its line") {
    const TemporaryFolder folder;
    const auto message = [&](const std::string& name) -> std::string {
        const std::string path = std::string(PLUVIA_SOURCE_DIR) + "/tests/fuzz/config/" + name;
        try {
            read_dataset_config(path);
        } catch (const Error& e) {
            CHECK(e.code() == ExitCode::usage);
            return e.what();
        }
        return "";
    };
    for (const char* name : {"refused_cycle.yaml", "refused_cycle_list.yaml", "refused_bomb.yaml"}) {
        CAPTURE(message(name));
        CHECK(message(name).find("is nested too deep or repeats itself") != std::string::npos);
    }
    CHECK(message("refused_deep.yaml").find("refused_deep.yaml:1: ") != std::string::npos);
}
