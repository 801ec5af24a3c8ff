// The Japanese street is whole, as scene_checks.h has it.
#include "scenes/builders.h"
#include "tests/scene_checks.h"

#include <doctest/doctest.h>

using namespace pluvia;

namespace {

/// Built once: a second costs as much as all checks.
const Scene& street() {
    static const Scene scene = build_japanesestreet();
    return scene;
}

}  // namespace

TEST_CASE("the Japanese street has half a million to five million triangles and passes the scene's own check") {
    const size_t placed = placed_triangles(street());
    CAPTURE(placed);
    CHECK(placed >= 500000);
    CHECK(placed <= 5000000);
    CHECK_NOTHROW(check(street(), "japanesestreet"));
}

TEST_CASE("pictures, vertices and triangles of the Japanese street are in order") {
    check_pictures(street());
    check_vertices(street());
    check_triangles(street());
}

TEST_CASE("the Japanese street has its cameras, classes and lamps") {
    check_cameras(street(), {"camera1", "camera2", "camera3", "camera4", "camera5", "camera6", "camera7", "camera8",
                             "camera9", "camera10"});
    check_classes(street(), {"road", "sidewalk", "building", "pole", "static"});
    check_lamps(street(), 100, 12000);  // signs alone are dozens
}

TEST_CASE("building the Japanese street twice gives the same file, and the file holds the same street") {
    check_file(street(), build_japanesestreet(), 60e6);
}
