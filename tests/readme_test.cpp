// What the README promises: its commands run, and what it points to exists.
#include "tests/temporary_folder.h"

#include <doctest/doctest.h>

#include <sys/wait.h>
#include <cstdlib>
#include <regex>
#include <vector>

namespace pluvia {
namespace {

namespace fs = std::filesystem;

const std::string root = PLUVIA_SOURCE_DIR;

/// Lines that call the program, in the README's shell blocks and in the demo.
std::vector<std::string> commands() {
    std::vector<std::string> lines;
    bool in_shell = false;
    std::istringstream readme(read_file(root + "/README.md"));
    for (std::string line; std::getline(readme, line);) {
        if (line.starts_with("```"))
            in_shell = line == "```sh";
        else if (in_shell && line.starts_with("build/pluvia"))
            lines.push_back(line);
    }
    std::istringstream demo(read_file(root + "/tools/demo.sh"));
    for (std::string line; std::getline(demo, line);)
        if (line.starts_with("build/pluvia")) lines.push_back(line);
    return lines;
}

/// The configurations of datasets that come with Pluvia, as they are but for the size of the picture.
void write_small_configurations(const std::string& folder) {
    fs::create_directory(folder);
    for (const auto& entry : fs::directory_iterator(root + "/scenes")) {
        if (entry.path().extension() != ".yaml") continue;
        const std::string yaml = std::regex_replace(read_file(entry.path()), std::regex("\nsize: .*"), "\nsize: 32x16");
        write_file(folder + "/" + entry.path().filename().string(),
                   std::regex_replace(yaml, std::regex("\nspp: .*"), "\nspp: 1"));
    }
}

}  // namespace

TEST_CASE("every command of the README and the demo runs") {
    const auto lines = commands();
    REQUIRE(lines.size() >= 5);
    const TemporaryFolder folder;
    fs::create_directory(folder / "build");
    fs::create_symlink(PLUVIA_PROGRAM, folder / "build/pluvia");
    write_small_configurations(folder / "scenes");
    for (std::string line : lines) {
        line = line.substr(0, line.find(" #"));
        // As written but for the size of the picture; of options given twice the last one counts.
        if (line.starts_with("build/pluvia render")) line += " --size 64x32 --spp 1 --overwrite --progress none";
        if (line.starts_with("build/pluvia validate trade"))
            line += " --size 16x8 --reference-spp 256 --only bounces --progress none";
        CAPTURE(line);
        const int status = std::system(("cd " + folder.path() + " && " + line + " >log 2>&1").c_str());
        CAPTURE(read_file(folder / "log"));
        CHECK(WIFEXITED(status));
        CHECK(WEXITSTATUS(status) == 0);
    }
}

TEST_CASE("every file that the README names exists") {
    const std::string readme = read_file(root + "/README.md");
    const std::regex link(R"(\]\(([^)#:]+)\)|\b(tools/\w+\.sh)\b)");
    int found = 0;
    for (std::sregex_iterator it(readme.begin(), readme.end(), link), end; it != end; ++it, ++found) {
        const std::string path = (*it)[1].matched ? (*it)[1] : (*it)[2];
        CAPTURE(path);
        CHECK(fs::exists(root + "/" + path));
    }
    CHECK(found >= 3);
}

}  // namespace pluvia
