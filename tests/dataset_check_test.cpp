// Proving a dataset: every fault that is planted is found, and what loaders rely on holds.
#include "renderer/image/exr.h"
#include "renderer/image/image_io.h"
#include "tests/dataset_fixture.h"
#include "tools/dataset/check.h"
#include "tools/frame_file.h"

#include <functional>
#include <limits>
#include <set>

namespace pluvia {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// A dataset made once for all tests, of which each has a copy.
const SmallDataset& made(const std::string& composition) {
    static const SmallDataset paper(2, "composition: paper\n"), physical(2, "bits: 16\nexr: true\nfog-beta: 0.002\n");
    const SmallDataset& dataset = composition == "paper" ? paper : physical;
    if (!fs::exists(dataset.folder / "out")) REQUIRE(dataset.command("run", "out").exit_code == 0);
    return dataset;
}

class Copy {
public:
    explicit Copy(const std::string& composition = "paper") : source_(made(composition)) {
        fs::copy(source_.folder / "out", path(), fs::copy_options::recursive);
    }
    std::string path() const { return folder_ / "out"; }
    std::string operator/(const std::string& name) const { return path() + "/" + name; }

    CheckReport check() const { return check_dataset(source_.config(), path()); }
    /// The faults, one a line.
    std::string faults() const {
        std::string text;
        for (const std::string& fault : check().faults) text += fault + "\n";
        return text;
    }

    Json record(const std::string& id) const { return Json::parse(read_file(*this / ("records/" + id + ".json"))); }
    void write_record(const std::string& id, const Json& json) const {
        write_file(*this / ("records/" + id + ".json"), json.dump());
    }
    /// After a file was changed: its record agrees with it again, so that only its content can betray it.
    void vouch_for(const std::string& id) const {
        Json json = record(id);
        for (Json& file : json["files"]) {
            const std::string full = *this / file["path"].get<std::string>();
            file["bytes"] = fs::file_size(full), file["xxh3"] = hash_file(full);
        }
        write_record(id, json);
    }

private:
    const SmallDataset& source_;
    TemporaryFolder folder_;
};

void write_png(const std::string& path, const Image<Rgba8>& image, int channels) {
    std::vector<uint8_t> packed;
    for (const Rgba8 p : image.pixels) {
        const uint8_t values[] = {p.r, p.g, p.b, p.a};
        packed.insert(packed.end(), values, values + channels);
    }
    PngWriter file(path, image.width, image.height, channels, 8);
    file.write_rows(0, image.height, packed.data());
    file.finish();
}

const std::string id = "court/eye/frame_0000", rainy = "rainy/court/eye/100mm/wind_-2/";

}  // namespace

TEST_CASE("an untouched dataset has no faults, paper or physical, 8 bits or 16 with all layers") {
    for (const char* composition : {"paper", "physical"}) {
        const Copy copy(composition);
        const CheckReport report = copy.check();
        CAPTURE(copy.faults());
        CHECK(report.faults.empty());
        CHECK(report.warnings.empty());
        CHECK(report.frames == 4);
        CHECK(report.files == (std::string(composition) == "paper" ? 4 * (3 + 2 * 4) : 4 * (4 + 2 * 6)));
    }
}

TEST_CASE("streaks cover some of the pictures of the test's dataset") {
    const Json pairs = Copy().record(id)["pairs"];
    CHECK(pairs[0]["mask_share"].get<double>() > 0);
    CHECK(pairs[1]["coverage"].get<double>() > pairs[0]["coverage"].get<double>());
    CHECK(pairs[1]["mask_share"].get<double>() > 0.01);
}

TEST_CASE("every fault planted in files, records and lists is found and named") {
    struct Fault {
        std::string what;  // part of the message
        std::function<void(const Copy&)> plant;
    };
    const std::string background = "clean/" + std::string("court/eye/background/frame_0000.jpg");
    const std::vector<Fault> faults = {
        {"is missing", [&](const Copy& c) { fs::remove(c / background); }},
        {"another size", [&](const Copy& c) { fs::resize_file(c / background, 100); }},
        {"other bytes",
         [&](const Copy& c) {
             std::string bytes = read_file(c / background);
             bytes[bytes.size() / 2] = char(bytes[bytes.size() / 2] ^ 1);
             write_file(c / background, bytes);
         }},
        {"frame_0000.json: is missing", [&](const Copy& c) { fs::remove(c / ("records/" + id + ".json")); }},
        {"is damaged", [&](const Copy& c) { write_file(c / ("records/" + id + ".json"), "{\"id\""); }},
        {"of other settings",
         [&](const Copy& c) {
             Json j = c.record(id);
             j["settings_hash"] = "0123456789abcdef";
             c.write_record(id, j);
         }},
        {"belongs to no frame",
         [&](const Copy& c) { write_file(c / "clean/court/eye/background/frame_0002.jpg", "x"); }},
        {"trainset.json: is not what the records give",
         [&](const Copy& c) { write_file(c / "trainset.json", read_file(c / "trainset.json") + " "); }},
        {"testset.json: is missing", [&](const Copy& c) { fs::remove(c / "testset.json"); }},
        {"cameras.jsonl: is missing", [&](const Copy& c) { fs::remove(c / "cameras.jsonl"); }},
        {"the camera court/eye is in trainset.json too",
         [&](const Copy& c) { write_file(c / "testset.json", read_file(c / "trainset.json")); }},
        {"no key \"rainy_depth\"",
         [&](const Copy& c) {
             Json list = Json::parse(read_file(c / "trainset.json"));
             list[1].erase("rainy_depth");
             write_file(c / "trainset.json", list.dump());
         }},
        {"the scene is another",
         [&](const Copy& c) {
             // As when a scene was edited between two shards: each record is right by itself.
             const auto items = dataset_items(made("paper").config());
             Json j = c.record(id);
             j["scene_hash"] = "0123456789abcdef";
             j["settings_hash"] = settings_hash(items[0], {}, "0123456789abcdef");
             c.write_record(id, j);
         }},
        {"did not add up",
         [&](const Copy& c) {
             Json j = c.record(id);
             j["residual"] = 1e-3;
             c.write_record(id, j);
         }},
        {"depths are no numbers",
         [&](const Copy& c) {
             std::vector<float> z(64 * 32, 5);
             z[7] = std::numeric_limits<float>::quiet_NaN();
             ExrWriter file(c / "clean/court/eye/metric_depth/frame_0000.exr", 64, 32, {{"Z", false}});
             const ExrRows rows = z.data();
             file.write_rows(0, 32, std::span(&rows, 1));
             file.finish();
             c.vouch_for(id);
         }},
        {"depths are not those of",
         [&](const Copy& c) {
             fs::copy_file(c / "clean/court/low/depth/frame_0000.png", c / "clean/court/eye/depth/frame_0000.png",
                           fs::copy_options::overwrite_existing);
             c.vouch_for(id);
         }},
        {"is another picture (got 16 x 16",
         [&](const Copy& c) {
             write_png(c / (rainy + "rainy_image/frame_0000.png"), Image<Rgba8>(16, 16), 3);
             c.vouch_for(id);
         }},
        {"3 channels of 8 bits, expected 64 x 32, 4",
         [&](const Copy& c) {
             write_png(c / (rainy + "rain_layer/frame_0000.png"), Image<Rgba8>(64, 32), 3);
             c.vouch_for(id);
         }},
        {"is not the sum of background and rain",
         [&](const Copy& c) {
             const std::string path = c / (rainy + "rainy_image/frame_0000.png");
             Image<Rgba8> image = read_rgba8(path);
             for (int y = 0; y < 8; ++y)
                 for (int x = 0; x < 8; ++x) image.at(x, y) = {255, 0, 0};
             write_png(path, image, 3);
             c.vouch_for(id);
         }},
        {"is not the sum of background and rain",
         [&](const Copy& c) {
             Image<Rgba8> image = read_rgba8(c / background);
             for (int y = 0; y < 16; ++y)
                 for (int x = 0; x < 16; ++x) image.at(x, y).g = uint8_t(image.at(x, y).g / 2);
             const auto bytes = encode_jpeg(image, 95);
             write_file(c / background, std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
             c.vouch_for(id);
         }},
        {"coverage at 100 mm/h is below",
         [&](const Copy& c) {
             const std::string path = c / (rainy + "rain_layer/frame_0000.png");
             Image<Rgba8> layer = read_rgba8(path);
             for (Rgba8& p : layer.pixels) p.a = 0;
             write_png(path, layer, 4);
             c.vouch_for(id);
         }},
        {"mean of alpha is not the recorded coverage",
         [&](const Copy& c) {
             Json j = c.record(id);
             j["pairs"][1]["coverage"] = 0.5;
             c.write_record(id, j);
         }},
        {"not where alpha of the rain layer is 0.01",
         [&](const Copy& c) {
             const std::string path = c / (rainy + "rain_mask/frame_0000.png");
             Image<Rgba8> mask = read_rgba8(path);
             for (Rgba8& p : mask.pixels) p.r = uint8_t(255 - p.r);
             write_png(path, mask, 1);
             c.vouch_for(id);
         }},
        {"neither 0 nor 255",
         [&](const Copy& c) {
             const std::string path = c / (rainy + "rain_mask/frame_0000.png");
             Image<Rgba8> mask = read_rgba8(path);
             mask.pixels[3].r = 128;
             write_png(path, mask, 1);
             c.vouch_for(id);
         }},
        {"streaks are behind the scene",
         [&](const Copy& c) {
             const std::vector<uint16_t> far(64 * 32, 65535);
             PngWriter file(c / (rainy + "depth/frame_0000.png"), 64, 32, 1, 16);
             file.write_rows(0, 32, far.data());
             file.finish();
             c.vouch_for(id);
         }},
        {"truncated or damaged",
         [&](const Copy& c) {
             const std::string path = c / (rainy + "rainy_image/frame_0000.png");
             fs::resize_file(path, fs::file_size(path) / 2);
             c.vouch_for(id);
         }},
    };
    for (const Fault& fault : faults) {
        const Copy copy;
        fault.plant(copy);
        const std::string found = copy.faults();
        CAPTURE(fault.what);
        CAPTURE(found);
        CHECK(found.find(fault.what) != std::string::npos);
    }
}

TEST_CASE("a layer of the EXR file that does not add up is found") {
    const Copy copy("physical");
    const std::string path = copy / "exr/court/eye/frame_0000.exr";
    std::vector<ExrChannel> channels;
    std::vector<std::vector<float>> planes;
    {
        ExrReader exr(path);
        channels = exr.channels();
        planes.assign(channels.size(), std::vector<float>(64 * 32));
        std::vector<ExrRequest> requests;
        for (size_t i = 0; i < channels.size(); ++i) requests.push_back({channels[i].name, planes[i].data()});
        exr.read_rows(0, 32, requests);
    }
    for (size_t i = 0; i < channels.size(); ++i)
        if (channels[i].name == "rain_100.G") planes[i][40] += 1;
    ExrWriter file(path, 64, 32, channels);
    std::vector<ExrRows> rows;
    for (const auto& plane : planes) rows.push_back(plane.data());
    file.write_rows(0, 32, rows);
    file.finish();
    copy.vouch_for(id);
    CHECK(copy.faults().find("frame_0000.exr: the layers do not add up") != std::string::npos);
}

TEST_CASE("check ends with 1 where there are faults, and says what repairs them") {
    const SmallDataset small;
    REQUIRE(small.command("run", "out", "--shard 1/2").exit_code == 0);
    const Outcome check = small.command("check", "out", "--json");
    CHECK(check.exit_code == 1);
    CHECK(Json::parse(check.out)["missing"] == 2);
    CHECK(check.err.find("pluvia dataset run repairs") != std::string::npos);
}

TEST_CASE("HRI's loaders find what they rely on: keys, types, folders, formats, thresholds") {
    const Copy copy;
    std::set<std::string> prediction_names;
    for (const char* name : {"trainset.json", "testset.json"}) {
        const Json list = Json::parse(read_file(copy / name));
        REQUIRE(list.is_array());
        CHECK(list.size() == 4);
        for (const Json& pair : list) {
            for (const char* key : hri_keys) CHECK(pair.contains(key));
            CHECK(pair["intensity"].is_number_integer());
            for (const auto& [key, value] : pair.items()) CHECK_FALSE(value.is_structured());  // flat
            const std::string scene = pair["scene"], sequence = pair["sequence"], wind = pair["wind"];
            const std::string clean = "clean/" + scene + "/" + sequence + "/";
            const std::string in_rain =
                "rainy/" + scene + "/" + sequence + "/" + pair["intensity"].dump() + "mm/" + wind + "/";
            const std::string background = pair["background"], frame = fs::path(background).stem();
            CHECK(background == clean + "background/" + frame + ".jpg");
            CHECK(pair["depth"] == clean + "depth/" + frame + ".png");
            CHECK(pair["rain_layer"] == in_rain + "rain_layer/" + frame + ".png");
            CHECK(pair["rainy_depth"] == in_rain + "depth/" + frame + ".png");
            CHECK(pair["rainy_image"] == in_rain + "rainy_image/" + frame + ".png");
            CHECK(frame.starts_with("frame_"));
            CHECK(read_image_info(copy / background).channels == 3);
            CHECK(read_image_info(copy / pair["depth"].get<std::string>()).bits == 16);
            CHECK(read_image_info(copy / pair["rain_layer"].get<std::string>()).channels == 4);
            CHECK(read_image_info(copy / pair["rainy_image"].get<std::string>()).channels == 3);
            // The loader's mask, alpha / 255 >= 0.01, is the rain mask.
            const Image<Rgba8> layer = read_rgba8(copy / pair["rain_layer"].get<std::string>());
            const Image<Rgba8> mask = read_rgba8(copy / pair["rain_mask"].get<std::string>());
            for (size_t i = 0; i < layer.pixels.size(); ++i)
                CHECK((layer.pixels[i].a / 255.0 >= 0.01) == (mask.pixels[i].r == 255));
            // How the loader's authors name what a network predicts: no two pairs may share it.
            prediction_names.insert(scene + "_" + sequence + "_" + pair["intensity"].dump() + "_" + wind + "_" + frame);
        }
    }
    CHECK(prediction_names.size() == 8);
}

TEST_CASE("depth times depth_max_m is metres, and cameras.jsonl has a pose for every frame") {
    const Copy copy;
    const Json pair = Json::parse(read_file(copy / "trainset.json"))[0];
    const Image<uint16_t> depth = read_grey16(copy / pair["depth"].get<std::string>());
    ExrReader exr(copy / pair["metric_depth"].get<std::string>());
    std::vector<float> z(64 * 32);
    const ExrRequest request{"Z", z.data()};
    exr.read_rows(0, 32, std::span(&request, 1));
    const double depth_max = pair["depth_max_m"];
    int compared = 0;
    for (size_t i = 0; i < z.size(); ++i)
        if (depth.pixels[i] != 65535) {
            ++compared;
            CHECK(std::abs(depth.pixels[i] / 65535.0 * depth_max - z[i]) <= 0.51 * depth_max / 65535);
        }
    CHECK(compared > 100);
    std::istringstream cameras(read_file(copy / "cameras.jsonl"));
    int lines = 0;
    for (std::string line; std::getline(cameras, line); ++lines) {
        const Json j = Json::parse(line);
        CHECK(j["world_from_camera"].size() == 4);
        CHECK(j["intrinsics"].size() == 3);
    }
    CHECK(lines == 4);
}

}  // namespace pluvia
