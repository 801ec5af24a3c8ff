// The house in its include lines: arrows point to the same floor or down, every library has one door.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

struct Room {
    std::string folder;
    std::vector<std::string> may_include;  // folders, itself included
};

const std::vector<Room> rooms = {
    {"tests", {""}},
    {"tools/learning", {"tools/learning", "renderer/image", "renderer/core"}},
    {"tools", {"tools", "scenes", "renderer", "shaders"}},
    {"scenes", {"scenes", "renderer/scene", "renderer/image", "renderer/core"}},
    {"renderer/transport", {"renderer", "shaders"}},
    {"renderer/accel", {"renderer/accel", "renderer/scene", "renderer/core"}},
    {"renderer/scene", {"renderer/scene", "shaders", "renderer/image", "renderer/core"}},
    {"renderer/rain", {"renderer/rain", "shaders", "renderer/core"}},
    {"shaders", {"shaders", "renderer/image", "renderer/core"}},
    {"renderer/image", {"renderer/image", "renderer/core"}},
    {"renderer/core", {"renderer/core"}},
};

/// Start of an outside include and the files that may have it. tools/bench measures libraries themselves.
const std::map<std::string, std::string> doors = {
    {"embree", "renderer/accel/ray_scene"},
    {"tbb/", "renderer/core/parallel"},
    {"tiny_gltf", "renderer/scene/gltf_"},
    {"draco/", "renderer/scene/gltf_draco"},
    {"meshoptimizer", "renderer/scene/gltf_meshopt"},
    {"OpenImageIO", "renderer/image/image_io"},
    {"OpenEXR", "renderer/image/exr"},
    {"Imf", "renderer/image/exr"},
    {"Imath", "renderer/image/exr"},
    {"OpenColorIO", "renderer/image/color"},
    {"webp/", "renderer/image/webp"},
    {"png.h", "renderer/image/png"},
    {"CLI/", "tools/"},
    {"yaml-cpp", "tools/dataset/config_tree"},
    {"archive", "tools/dataset/tar_file"},
    {"xxhash", "tools/dataset/file_hash"},
    {"torch/", "tools/learning/"},
    {"ATen/", "tools/learning/"},
    {"doctest", "tests/"},
};

struct Include {
    std::string file, target;
    bool quoted;
};

std::vector<Include> all_includes() {
    const std::regex line_pattern(R"re(^\s*#\s*include\s*([<"])([^>"]+)[>"])re");
    std::vector<Include> includes;
    for (const char* top : {"renderer", "shaders", "scenes", "tools", "tests"})
        for (const auto& entry : fs::recursive_directory_iterator(fs::path(PLUVIA_SOURCE_DIR) / top)) {
            const std::string extension = entry.path().extension();
            if (extension != ".h" && extension != ".cpp") continue;
            std::ifstream file(entry.path());
            for (std::string line; std::getline(file, line);) {
                std::smatch match;
                if (std::regex_search(line, match, line_pattern))
                    includes.push_back(
                        {fs::relative(entry.path(), PLUVIA_SOURCE_DIR).string(), match[2], match[1] == "\""});
            }
        }
    return includes;
}

bool is_under(const std::string& path, const std::string& folder) {
    return folder.empty() || path.starts_with(folder + "/");
}

}  // namespace

TEST_CASE("every include goes to the same floor or down") {
    const auto includes = all_includes();
    REQUIRE(includes.size() > 100);
    for (const Include& include : includes) {
        if (!include.quoted) continue;
        CAPTURE(include.file);
        CAPTURE(include.target);
        CHECK(fs::exists(fs::path(PLUVIA_SOURCE_DIR) / include.target));  // written from the root
        const auto room =
            std::find_if(rooms.begin(), rooms.end(), [&](const Room& r) { return is_under(include.file, r.folder); });
        REQUIRE(room != rooms.end());
        CHECK(std::any_of(room->may_include.begin(), room->may_include.end(),
                          [&](const std::string& folder) { return is_under(include.target, folder); }));
    }
}

TEST_CASE("every outside library is included through its one door") {
    for (const Include& include : all_includes()) {
        if (include.quoted || is_under(include.file, "tools/bench")) continue;
        for (const auto& [library, door] : doors) {
            if (!include.target.starts_with(library)) continue;
            CAPTURE(include.file);
            CAPTURE(include.target);
            CHECK(include.file.starts_with(door));
        }
    }
}
