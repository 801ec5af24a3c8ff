// `pluvia dataset plan`: what it measures is what frames take.
#include "tests/dataset_fixture.h"
#include "tools/dataset/plan.h"
#include "tools/dataset/scene_source.h"

#include <sys/resource.h>
#include <csignal>

namespace pluvia {
namespace {

using Json = nlohmann::ordered_json;

/// Of programs that have ended; seconds.
double processor_seconds() {
    rusage usage = {};
    getrusage(RUSAGE_CHILDREN, &usage);
    const auto seconds = [](timeval t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

Json planned(const SmallDataset& small, const std::string& output = "out") {
    const Outcome plan = small.command("plan", output, "--json --progress none");
    REQUIRE_MESSAGE(plan.exit_code == 0, plan.err);
    return Json::parse(plan.out);
}

/// Of all files of frames.
double picture_bytes(const std::string& dataset) {
    double sum = 0;
    for (const auto& [path, content] : product_files(dataset))
        if (path.starts_with("clean/") || path.starts_with("rainy/") || path.starts_with("exr/"))
            sum += double(content.size());
    return sum;
}

void replace(const SmallDataset& small, const std::string& what, const std::string& with) {
    std::string yaml = read_file(small.config_path());
    yaml.replace(yaml.find(what), what.size(), with);
    write_file(small.config_path(), yaml);
}

}  // namespace

TEST_CASE("a plan's processor time and disk are those of the run, to a factor of 2") {
    const SmallDataset small(2, "composition: paper\nlayers: [instance, boxes]\nexr: true\n");
    replace(small, "size: 64x32\nspp: 2", "size: 192x96\nspp: 16");
    const Json plan = planned(small);
    const double before = processor_seconds();
    REQUIRE(small.command("run", "run").exit_code == 0);
    const double ran = processor_seconds() - before;
    const double said = 4 * plan["scenes"][0]["processor_seconds_per_frame"].get<double>();
    // Measured pixels are some of the picture's, with few samples. The program's start, a third of so short a run, is
    // not in the plan, and others share the machine.
    CAPTURE(said);
    CAPTURE(ran);
    CHECK(said < 2 * ran);
    CHECK(said > ran / 2);
    // Told from a small picture of fewer samples.
    const double bytes = plan["bytes"].get<double>(), written = picture_bytes(small.folder / "run");
    CAPTURE(bytes);
    CAPTURE(written);
    CHECK(bytes > 0.8 * written);
    CHECK(bytes < 1.5 * written);
}

TEST_CASE("frames that are there tell a plan what others take") {
    const SmallDataset small;
    REQUIRE(small.command("run", "out", "--shard 1/2").exit_code == 0);
    const Json scene = planned(small)["scenes"][0];
    CHECK(scene["seconds_per_frame"].get<double>() > 0);
    CHECK_FALSE(scene.contains("processor_seconds_per_frame"));  // logs hold time by the clock alone
    CHECK(scene["bytes_per_frame"].get<double>() * 2 == doctest::Approx(picture_bytes(small.folder / "out")));
}

TEST_CASE("scenes of one file are read once for a time, and anew for another or with other options") {
    const SmallDataset small;
    write_file(small.config_path(), read_file(small.config_path()) +
                                        "  - scene: court.glb\n    name: other\n    frames: 1\n    train: [eye]\n");
    const DatasetConfig config = small.config();
    SceneSource source(config, small.folder.path());
    RenderOptions options = config.scenes[0].options;
    const Mesh* mesh = source.at(0, options).scene.meshes.data();
    CHECK(source.at(1, options).scene.meshes.data() == mesh);
    options.frame = 1;
    CHECK(source.at(1, options).scene.meshes.data() == mesh);  // nothing moves in the court
    options.texture_size = 16;
    std::filesystem::remove(small.folder / "court.glb");
    CHECK_THROWS_AS(source.at(1, options), Error);
}

TEST_CASE("an interrupted plan stops with 75") {
    const SmallDataset small(50, "composition: paper\nlayers: [instance]\nexr: true\nsize: 512x256\n");
    replace(small, "size: 64x32\n", "");
    const std::string command = "sh -c '" + std::string(PLUVIA_PROGRAM) + " dataset plan " + small.arguments("out") +
                                " --progress json >/dev/null 2>" + (small.folder / "err") +
                                " & child=$!; until grep -q progress " + (small.folder / "err") +
                                "; do sleep 0.02; done; kill -INT $child; wait $child'";
    const int status = std::system(command.c_str());
    REQUIRE(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 75);
}

}  // namespace pluvia
