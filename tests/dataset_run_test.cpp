// Making a dataset: whatever happens on the way, the bytes in the end are the same.
#include "renderer/core/random.h"
#include "tests/dataset_fixture.h"

#include <nlohmann/json.hpp>

#include <fcntl.h>
#include <sys/wait.h>
#include <chrono>
#include <csignal>
#include <thread>

namespace pluvia {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// A run in a process of its own.
class Run {
public:
    Run(const SmallDataset& small, const std::string& output, const std::string& shard = "1/1") {
        const std::string config = small.config_path(), folder = small.folder / output;
        process_ = fork();
        if (process_ == 0) {
            const int null = open("/dev/null", O_WRONLY);
            dup2(null, 1), dup2(null, 2);
            execl(PLUVIA_PROGRAM, "pluvia", "dataset", "run", config.c_str(), "-o", folder.c_str(), "--shard",
                  shard.c_str(), "--progress", "none", static_cast<char*>(nullptr));
            _exit(127);
        }
    }
    ~Run() {
        if (!ended_) end_with(SIGKILL);
    }
    /// The exit code; 128 + the signal where one ended it.
    int end_with(int signal) {
        kill(process_, signal);
        return wait();
    }
    int wait() {
        int status = 0;
        waitpid(process_, &status, 0);
        ended_ = true;
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }
    bool has_ended() {
        int status = 0;
        ended_ = ended_ || waitpid(process_, &status, WNOHANG) == process_;
        return ended_;
    }

private:
    pid_t process_ = 0;
    bool ended_ = false;
};

size_t record_count(const std::string& folder) {
    size_t count = 0;
    std::error_code error;
    for (fs::recursive_directory_iterator it(folder + "/records", error), end; !error && it != end; it.increment(error))
        count += it->path().extension() == ".json";
    return count;
}

void sleep_ms(int ms) {
    std::this_thread::sleep_for(std::chrono::milliseconds(ms));
}

}  // namespace

TEST_CASE("a run killed at ten random moments and resumed gives the bytes of an unbroken one") {
    const SmallDataset small(12);
    REQUIRE(small.command("run", "whole").exit_code == 0);
    int killed = 0, with_leftovers = 0;
    for (uint64_t i = 0; i < 10; ++i) {
        const size_t before = record_count(small.folder / "broken");
        Run run(small, "broken");
        // After one or two further frames, and then at any point of the next.
        const size_t wanted = before + (mix_bits(2 * i + 77) & 1);
        while (record_count(small.folder / "broken") < wanted && !run.has_ended()) sleep_ms(1);
        std::this_thread::sleep_for(std::chrono::microseconds(mix_bits(2 * i + 78) % 60000));
        if (run.has_ended()) break;
        killed += run.end_with(SIGKILL) == 128 + SIGKILL;
        with_leftovers += fs::exists(small.folder / "broken/work");
    }
    CHECK(killed == 10);
    CHECK(with_leftovers >= 5);  // most kills met a frame in work
    CHECK(record_count(small.folder / "broken") < 24);
    REQUIRE(small.command("run", "broken").exit_code == 0);
    CHECK(difference(product_files(small.folder / "whole"), product_files(small.folder / "broken")) == "");
}

TEST_CASE("three shards merged give the bytes of an unsharded run, also when made in folders of their own") {
    const SmallDataset small(4);
    REQUIRE(small.command("run", "whole").exit_code == 0);
    const auto whole = product_files(small.folder / "whole");
    {
        Run a(small, "parts", "1/3"), b(small, "parts", "2/3"), c(small, "parts", "3/3");
        CHECK(a.wait() == 0);
        CHECK(b.wait() == 0);
        CHECK(c.wait() == 0);
    }
    CHECK_FALSE(fs::exists(small.folder / "parts/trainset.json"));  // a shard does not know that it is the last
    CHECK(small.command("merge", "parts").exit_code == 0);
    CHECK(difference(whole, product_files(small.folder / "parts")) == "");

    for (const char* part : {"1", "2", "3"})
        REQUIRE(small.command("run", std::string("machine") + part, std::string("--shard ") + part + "/3").exit_code ==
                0);
    const std::string from = " --from " + (small.folder / "machine2") + " --from " + (small.folder / "machine3");
    CHECK(small.command("merge", "machine1", from).exit_code == 0);
    CHECK(difference(whole, product_files(small.folder / "machine1")) == "");
}

TEST_CASE("a second run makes nothing that is right and repairs what is not") {
    const SmallDataset small;
    REQUIRE(small.command("run", "out").exit_code == 0);
    const std::string out = small.folder / "out";
    const auto whole = product_files(out);
    CHECK(small.command("run", "out").out.find("0 frames made, 4 done before") != std::string::npos);

    write_file(out + "/clean/court/eye/background/frame_0000.jpg", "no picture");  // another size
    std::string depth = read_file(out + "/clean/court/low/depth/frame_0001.png");
    depth[depth.size() / 2] = char(depth[depth.size() / 2] ^ 1);  // the same size
    write_file(out + "/clean/court/low/depth/frame_0001.png", depth);
    fs::remove(out + "/rainy/court/eye/10mm/wind_1_0_2/rain_layer/frame_0001.png");
    CHECK(small.command("run", "out").out.find("3 frames made, 1 done before") != std::string::npos);
    CHECK(difference(whole, product_files(out)) == "");
}

TEST_CASE("frames of other settings are made anew and leave no old files") {
    const SmallDataset small;
    REQUIRE(small.command("run", "out").exit_code == 0);
    std::string yaml = read_file(small.config_path());
    yaml.replace(yaml.find("winds: [-2"), 10, "winds: [-3");  // of every first frame
    write_file(small.config_path(), yaml);
    CHECK(small.command("run", "out").out.find("2 frames made, 2 done before") != std::string::npos);
    CHECK_FALSE(fs::exists(small.folder / "out/rainy/court/eye/10mm/wind_-2/rainy_image/frame_0000.png"));
    CHECK(small.command("check", "out").exit_code == 0);
}

TEST_CASE("merge names the frames that are missing in a file that run takes") {
    const SmallDataset small;
    REQUIRE(small.command("run", "whole").exit_code == 0);
    REQUIRE(small.command("run", "out", "--shard 1/2").exit_code == 0);
    const Outcome merge = small.command("merge", "out");
    CHECK(merge.exit_code == 5);
    CHECK(merge.err.find("2 frames are missing") != std::string::npos);
    const std::string failed = small.folder / "out/failed.jsonl";
    CHECK(read_file(failed).find("court/low/frame_0001") != std::string::npos);
    const Outcome again = small.command("run", "out", "--only " + failed);
    CHECK(again.out.find("2 frames made, 0 done before") != std::string::npos);
    CHECK_FALSE(fs::exists(failed));
    CHECK(difference(product_files(small.folder / "whole"), product_files(small.folder / "out")) == "");
    write_file(small.folder / "list", "{\"id\": \"court/high/frame_0000\"}\n");
    CHECK(small.command("run", "out", "--only " + (small.folder / "list")).exit_code == 3);
}

TEST_CASE("signals that announce an end stop a run with 75, drop the frame in hand and keep the others") {
    for (const int signal : {SIGTERM, SIGUSR1}) {
        CAPTURE(signal);
        const SmallDataset small;
        std::string yaml = read_file(small.config_path());
        yaml.replace(yaml.find("    train: [eye]"), 16, "    train: [eye]\n    spp: 1000000");
        write_file(small.config_path(), yaml);
        Run run(small, "out");
        const auto in_work = [&] {
            std::error_code error;
            for (const auto& entry : fs::directory_iterator(small.folder / "out/work", error))
                if (fs::exists(entry.path() / "frame/layers.tmp.exr")) return true;
            return false;
        };
        for (int i = 0; i < 4000 && !in_work() && !run.has_ended(); ++i) sleep_ms(5);
        REQUIRE(in_work());
        CHECK(run.end_with(signal) == 75);
        CHECK_FALSE(fs::exists(small.folder / "out/work"));
        CHECK_FALSE(fs::exists(small.folder / "out/clean"));
    }
}

TEST_CASE("a disk that takes no more is an error that leaves finished frames as they are") {
    const SmallDataset small;
    REQUIRE(small.command("run", "out", "--shard 1/2").exit_code == 0);
    const auto before = product_files(small.folder / "out");
    // Files may not grow beyond 2 kB, and nobody is killed for trying.
    const std::string command = std::string("trap '' XFSZ; ulimit -f 4; ") + PLUVIA_PROGRAM + " dataset run " +
                                small.arguments("out") + " --progress none >/dev/null 2>" + (small.folder / "err");
    const int status = std::system(("sh -c \"" + command + "\"").c_str());
    REQUIRE(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 4);
    CHECK(read_file(small.folder / "err").find("cannot be written") != std::string::npos);
    CHECK(difference(before, product_files(small.folder / "out")) == "");
    CHECK(small.command("run", "out").out.find("2 frames made, 2 done before") != std::string::npos);
}

TEST_CASE("merge warns when frames come from different builds") {
    const SmallDataset small;
    REQUIRE(small.command("run", "out").exit_code == 0);
    CHECK(small.command("merge", "out").err.empty());
    const std::string path = small.folder / "out/records/court/eye/frame_0000.json";
    Json record = Json::parse(read_file(path));
    record["build"] = "0.0.9+0123456789abcdef";
    write_file(path, record.dump());
    const Outcome merge = small.command("merge", "out");
    CHECK(merge.err.find("different builds") != std::string::npos);
    CHECK(merge.err.find("0.0.9+0123456789abcdef: 1 frame") != std::string::npos);
}

TEST_CASE("status counts what is done, and how long the rest takes") {
    const SmallDataset small;
    REQUIRE(small.command("run", "out", "--shard 1/4").exit_code == 0);
    const Json j = Json::parse(small.command("status", "out", "--json").out);
    CHECK(j["frames"] == 4);
    CHECK(j["done"] == 1);
    const double seconds = j["scenes"][0]["seconds_per_frame"];
    CHECK(seconds > 0);
    CHECK(j["left_s"].get<double>() == doctest::Approx(3 * seconds));
}

TEST_CASE("a frame of a dataset is what render makes with its settings") {
    const SmallDataset small(2, "exr: true\n");
    REQUIRE(small.command("run", "out", "--shard 1/4").exit_code == 0);
    const Json record = Json::parse(read_file(small.folder / "out/records/court/eye/frame_0000.json"));
    const std::string options =
        " --camera eye --frame 0 --size 64x32 --spp 2 --streak-width 0.25 --rain 10,100 --wind=-2,0,0 --hour 10 "
        "--environment 80,90,100 --weather rain --depth-encoding hri --progress none --seed " +
        std::to_string(record["seed"].get<uint64_t>());
    REQUIRE(
        run_program("render " + (small.folder / "court.glb") + " -o " + (small.folder / "frame") + options).exit_code ==
        0);
    CHECK(read_file(small.folder / "frame/frame.exr") == read_file(small.folder / "out/exr/court/eye/frame_0000.exr"));
    CHECK(read_file(small.folder / "frame/depth.png") ==
          read_file(small.folder / "out/clean/court/eye/depth/frame_0000.png"));
    CHECK(read_file(small.folder / "frame/rainy_100.png") ==
          read_file(small.folder / "out/rainy/court/eye/100mm/wind_-2/rainy_image/frame_0000.png"));
}

}  // namespace pluvia
