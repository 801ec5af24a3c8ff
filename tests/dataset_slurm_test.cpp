// The template for job arrays on a real Slurm, which is there for the test alone.
#include "tests/dataset_fixture.h"

namespace pluvia {
namespace {

namespace fs = std::filesystem;
const std::string root = PLUVIA_SOURCE_DIR;

}  // namespace

TEST_CASE("a Slurm array gives the bytes of an unsharded run, also when a shard is lost in the first round" *
          doctest::skip()) {
    const SmallDataset small(3);
    REQUIRE(small.command("run", "whole").exit_code == 0);
    // The first run of the second shard is killed before it begins.
    write_file(small.folder / "pluvia", "#!/bin/sh\ncase \"$*\" in *\"--shard 2/3\"*) [ -e " + (small.folder / "lost") +
                                            " ] || { : >" + (small.folder / "lost") + "; kill -9 $$; };; esac\nexec " +
                                            PLUVIA_PROGRAM + " \"$@\"\n");
    fs::permissions(small.folder / "pluvia", fs::perms::owner_all);
    write_file(small.folder / "job.sh", "#!/bin/sh\nset -e\nexport PLUVIA=" + (small.folder / "pluvia") + "\n" + root +
                                            "/tools/dataset/slurm.sh " + small.config_path() + " " +
                                            (small.folder / "out") +
                                            " 3\nfor i in $(seq 600); do [ -z \"$(squeue -h)\" ] && exit 0; sleep 0.2; "
                                            "done\nexit 1\n");
    const int status = std::system(
        (root + "/tests/slurm_cluster.sh sh " + (small.folder / "job.sh") + " >" + (small.folder / "log") + " 2>&1")
            .c_str());
    REQUIRE(WIFEXITED(status));
    if (WEXITSTATUS(status) == 77) {
        MESSAGE("skipped: needs root, slurm-wlm and munge");
        return;
    }
    CAPTURE(read_file(small.folder / "log"));
    REQUIRE(WEXITSTATUS(status) == 0);
    CHECK(fs::exists(small.folder / "lost"));
    CHECK(difference(product_files(small.folder / "whole"), product_files(small.folder / "out")) == "");
}

}  // namespace pluvia
