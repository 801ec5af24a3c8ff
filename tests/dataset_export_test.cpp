// A dataset in the layouts of others, and what it says about itself.
#include "renderer/image/image_io.h"
#include "tests/dataset_fixture.h"

#include <fmt/format.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <set>

namespace pluvia {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

std::string shell(const std::string& command) {
    const TemporaryFolder folder;
    REQUIRE(std::system((command + " >" + (folder / "out")).c_str()) == 0);
    return read_file(folder / "out");
}

}  // namespace

TEST_CASE("SHA-256 and XXH3 give the published digests") {
    CHECK(sha256("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    CHECK(sha256("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    CHECK(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq") ==
          "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    CHECK(hash_text("") == 0x2d06800538d394c2);
    const TemporaryFolder folder;
    write_file(folder / "f", std::string(3000000, 'x'));
    CHECK(hash_file(folder / "f") == fmt::format("{:016x}", hash_text(std::string(3000000, 'x'))));
    CHECK(hash_file(folder / "absent").empty());
}

TEST_CASE("exports hold every pair in their own layout") {
    const SmallDataset small;
    REQUIRE(small.command("run", "out").exit_code == 0);
    SUBCASE("hri: the nine keys and the files they name, nothing else") {
        REQUIRE(small.command("export", "out", "--format hri --to " + (small.folder / "hri")).exit_code == 0);
        std::set<std::string> named = {"trainset.json", "testset.json"};
        for (const char* name : {"trainset.json", "testset.json"}) {
            const Json list = Json::parse(read_file(small.folder / (std::string("hri/") + name)));
            CHECK(list.size() == 4);
            for (const Json& pair : list) {
                CHECK(pair.size() == 9);
                for (const char* key : {"background", "depth", "rain_layer", "rainy_depth", "rainy_image"})
                    named.insert(pair.at(key).get<std::string>());
            }
        }
        const auto files = product_files(small.folder / "hri"), all = product_files(small.folder / "out");
        CHECK(files.size() == named.size());
        for (const std::string& path : named) {
            REQUIRE(files.contains(path));
            if (!path.ends_with(".json")) CHECK(files.at(path) == all.at(path));
        }
    }
    SUBCASE("hf: a line of metadata per pair, whose files are there") {
        REQUIRE(small.command("export", "out", "--format hf").exit_code == 0);
        const std::string folder = small.folder / "out-hf";
        for (const char* split : {"train", "test"}) {
            std::istringstream lines(read_file(folder + "/" + split + "/metadata.jsonl"));
            int count = 0;
            for (std::string line; std::getline(lines, line); ++count) {
                const Json j = Json::parse(line);
                CHECK(j["intensity"].is_number());
                int files = 0;
                for (const auto& [key, value] : j.items())
                    if (key == "file_name" || key.ends_with("_file_name")) {
                        ++files;
                        CHECK(fs::exists(folder + "/" + split + "/" + value.get<std::string>()));
                    }
                CHECK(files == 7);
            }
            CHECK(count == 4);
        }
        CHECK(read_file(folder + "/README.md").starts_with("---\nlicense: other\n"));
    }
    SUBCASE("webdataset: shards that tar reads, a sample per frame, the same bytes twice") {
        REQUIRE(small.command("export", "out", "--format webdataset --to " + (small.folder / "a")).exit_code == 0);
        REQUIRE(small.command("export", "out", "--format webdataset --to " + (small.folder / "b")).exit_code == 0);
        CHECK(product_files(small.folder / "a") == product_files(small.folder / "b"));
        const std::string tar = small.folder / "a/train-000000.tar";
        std::istringstream names(shell("tar tf " + tar));
        std::map<std::string, int> samples;
        for (std::string name; std::getline(names, name);) ++samples[name.substr(0, name.find('.'))];
        CHECK(samples == std::map<std::string, int>{{"court_eye_frame_0000", 12}, {"court_eye_frame_0001", 12}});
        CHECK(shell("tar xOf " + tar + " court_eye_frame_0001.background.jpg") ==
              read_file(small.folder / "out/clean/court/eye/background/frame_0001.jpg"));
        CHECK(Json::parse(shell("tar xOf " + tar + " court_eye_frame_0000.json"))[1]["intensity"] == 100);
    }
    SUBCASE("an export is neither mixed with what is there nor made of half a dataset") {
        CHECK(small.command("export", "out", "--to " + (small.folder / "out")).exit_code == 2);
        CHECK(small.command("export", "out", "--format zip").exit_code == 2);
        fs::remove(small.folder / "out/records/court/eye/frame_0000.json");
        CHECK(small.command("export", "out").exit_code == 1);
    }
}

TEST_CASE("the card has licence and counts, and Croissant metadata point to files with their hashes") {
    const SmallDataset small(2, "license: cc-by-4.0\nname: small\n");
    REQUIRE(small.command("run", "out").exit_code == 0);
    const std::string card = read_file(small.folder / "out/README.md");
    CHECK(card.starts_with("---\nlicense: cc-by-4.0\n"));
    CHECK(card.find("4 training and 4 test pairs of 64x32 pixels") != std::string::npos);
    const Json croissant = Json::parse(read_file(small.folder / "out/croissant.json"));
    CHECK(croissant["conformsTo"] == "http://mlcommons.org/croissant/1.0");
    CHECK(croissant["license"] == "cc-by-4.0");
    int objects = 0;
    for (const Json& part : croissant["distribution"])
        if (part["@type"] == "cr:FileObject") {
            ++objects;
            CHECK(part["sha256"] == sha256(read_file(small.folder / ("out/" + part["contentUrl"].get<std::string>()))));
        }
    CHECK(objects == 2);
    // Every field is extracted from a key that pairs have.
    const Json pair = Json::parse(read_file(small.folder / "out/trainset.json"))[0];
    for (const Json& field : croissant["recordSet"][0]["field"])
        CHECK(pair.contains(field["source"]["extract"]["jsonPath"].get<std::string>().substr(5)));
}

TEST_CASE("products hold no path, host or time of their making") {
    const SmallDataset small;
    REQUIRE(small.command("run", "out").exit_code == 0);
    std::string host(256, '\0');
    gethostname(host.data(), host.size());
    host = host.c_str();
    for (const auto& [path, bytes] : product_files(small.folder / "out")) {
        CAPTURE(path);
        CHECK(bytes.find(small.folder.path()) == std::string::npos);
        if (host.size() > 4) CHECK(bytes.find(host) == std::string::npos);
    }
}

TEST_CASE("the report needs no other file and has pictures and numbers of every frame it shows") {
    const SmallDataset small;
    REQUIRE(small.command("run", "out").exit_code == 0);
    REQUIRE(small.command("report", "out", "--frames 3").exit_code == 0);
    const std::string html = read_file(small.folder / "out/report.html");
    const size_t begin = html.find("const DATA=") + 11;
    const Json data = Json::parse(html.substr(begin, html.find(";\nfunction bind") - begin));
    REQUIRE(data["frames"].size() == 4);
    int shown = 0;
    for (const Json& frame : data["frames"]) {
        shown += frame.contains("clean");
        CHECK(frame["pairs"].size() == 2);
        CHECK(frame["pairs"][0].contains("rainy") == frame.contains("clean"));
    }
    CHECK(shown == 3);
    CHECK(html.find("http://") == std::string::npos);
    CHECK(html.find("https://") == std::string::npos);
}

TEST_CASE("the figure has a row per hour, and a column per wind and intensity beside the clean picture") {
    const SmallDataset small;
    REQUIRE(small.command("figure", "figure", "--hours 10,20 --winds=-2,0,2 --camera low").exit_code == 0);
    const ImageInfo info = read_image_info(small.folder / "figure/figure.png");
    CHECK(info.width == 7 * 64 + 6 * 6);
    CHECK(info.height == 2 * 32 + 6);
    CHECK(small.command("figure", "figure", "--camera high").exit_code == 2);
}

TEST_CASE("every stage explains itself, and the examples that it shows work one after the other") {
    const TemporaryFolder folder;
    fs::create_symlink(PLUVIA_PROGRAM, folder / "pluvia");
    fs::create_directory(folder / "scenes");
    for (const char* name : {"hri", "hri-smoke"}) {
        std::string yaml = read_file(std::string(PLUVIA_SOURCE_DIR) + "/scenes/" + name + ".yaml");
        // As it comes but for the size of the picture.
        yaml.replace(yaml.find("size: "), yaml.find('\n', yaml.find("size: ")) - yaml.find("size: "), "size: 32x16");
        yaml.replace(yaml.find("spp: "), yaml.find('\n', yaml.find("spp: ")) - yaml.find("spp: "), "spp: 1");
        write_file(folder / (std::string("scenes/") + name + ".yaml"), yaml);
    }
    int examples = 0;
    for (const char* stage : {"", "plan", "run", "status", "merge", "check", "export", "report", "figure"}) {
        std::istringstream help(run_program(std::string("dataset ") + stage + " --help").out);
        std::string line;
        while (std::getline(help, line) && line != "Example:") {
        }
        REQUIRE(std::getline(help, line));
        CAPTURE(line);
        CHECK(line.starts_with(std::string("  pluvia dataset ") + stage));
        // The example of run is one shard of four.
        if (std::string(stage) == "merge")
            REQUIRE(std::system(("cd " + folder.path() +
                                 " && ./pluvia dataset run scenes/hri-smoke.yaml -o out/smoke >log 2>&1")
                                    .c_str()) == 0);
        CHECK(std::system(("cd " + folder.path() + "; PATH=.:$PATH; { " + line + "; } >log 2>&1").c_str()) == 0);
        ++examples;
    }
    CHECK(examples == 9);
}

}  // namespace pluvia
