// Datasets with labels: made, proven and exported as other datasets are.
#include "tests/dataset_fixture.h"
#include "tools/dataset/check.h"
#include "tools/frame_file.h"

#include <algorithm>

namespace pluvia {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

const std::string rules = "- nodes: \"quad.*|box.*|court.*|.*\"\n  class: building\n";

/// Made once for all tests.
const SmallDataset& labelled() {
    static const SmallDataset dataset(1, "exr: true\nlayers: [semantic, instance, boxes, flow]\nlabels: labels.yaml\n");
    if (!fs::exists(dataset.folder / "out")) {
        write_file(dataset.folder / "labels.yaml", rules);
        const Outcome outcome = dataset.command("run", "out");
        REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
    }
    return dataset;
}

}  // namespace

TEST_CASE("a dataset with labels is proven whole, and a bent label is found") {
    const SmallDataset& dataset = labelled();
    const Outcome good = dataset.command("check", "out");
    CHECK_MESSAGE(good.exit_code == 0, good.out);
    const TemporaryFolder copy;
    fs::copy(dataset.folder / "out", copy / "out", fs::copy_options::recursive);
    const std::string path = copy / "out/records/court/eye/frame_0000.json";
    Json record = Json::parse(read_file(path));
    REQUIRE(record.contains("objects"));
    CHECK(record["objects"][0]["class"] == "building");
    record["objects"][0]["box"][0] = 1000;
    write_file(path, record.dump());
    const auto faults = check_dataset(dataset.config(), copy / "out").faults;
    REQUIRE(!faults.empty());
    CHECK(std::any_of(faults.begin(), faults.end(),
                      [](const std::string& f) { return f.find("does not hug it") != std::string::npos; }));
}

TEST_CASE("labels of a dataset are exported under names of their frames") {
    const SmallDataset& dataset = labelled();
    const TemporaryFolder folder;
    for (const char* format : {"cityscapes", "coco", "flo"}) {
        const Outcome outcome =
            dataset.command("export", "out", std::string("--format ") + format + " --to " + (folder / format));
        CHECK_MESSAGE(outcome.exit_code == 0, outcome.err);
    }
    CHECK(fs::exists(folder / "cityscapes/court_eye_frame_0000_gtFine_labelIds.png"));
    CHECK(fs::exists(folder / "coco/panoptic/court_low_frame_0000.png"));
    CHECK(fs::exists(folder / "flo/flow/court_eye_frame_0000_fwd.flo"));
}

TEST_CASE("frames are made anew when the rules of their labels change, and not otherwise") {
    const SmallDataset& dataset = labelled();
    CHECK(dataset.command("run", "out").out.find("0 frames made") != std::string::npos);
    write_file(dataset.folder / "labels.yaml", rules + "- nodes: nothing\n  class: car\n");
    CHECK(dataset.command("run", "out").out.find("2 frames made") != std::string::npos);
}

TEST_CASE("label layers without EXR files are refused, since they would be lost") {
    const SmallDataset dataset(1, "layers: semantic\n");
    const Outcome outcome = dataset.command("plan", "out", "--no-sample");
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.err.find("exr: true") != std::string::npos);
    const SmallDataset unknown(1, "exr: true\nlayers: [semantics]\n");
    const Outcome misspelt = unknown.command("plan", "out", "--no-sample");
    CHECK(misspelt.exit_code == 2);
    CHECK(misspelt.err.find("did you mean semantic?") != std::string::npos);
}

}  // namespace pluvia
