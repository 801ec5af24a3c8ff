// The city street is whole, as scene_checks.h has it.
#include "scenes/builders.h"
#include "tests/scene_checks.h"

#include <doctest/doctest.h>

using namespace pluvia;

namespace {

/// Built once: a second costs as much as all checks.
const Scene& street() {
    static const Scene scene = build_citystreet();
    return scene;
}

}  // namespace

TEST_CASE("the city street has half a million to five million triangles and passes the scene's own check") {
    const size_t placed = placed_triangles(street());
    CAPTURE(placed);
    CHECK(placed >= 500000);
    CHECK(placed <= 5000000);
    CHECK_NOTHROW(check(street(), "citystreet"));
}

TEST_CASE("pictures, vertices and triangles of the city street are in order") {
    check_pictures(street());
    check_vertices(street());
    check_triangles(street());
}

TEST_CASE("the city street has its cameras, classes and lamps") {
    check_cameras(street(), {"front", "far", "back", "sideleft", "sideright", "sideinner"});
    check_classes(street(),
                  {"road", "sidewalk", "building", "pole", "traffic sign", "vegetation", "car", "static", "terrain"});
    check_lamps(street(), 8 + 20, 20000);  // the street lamps and the lit windows of twenty houses
}

TEST_CASE("building the city street twice gives the same file, and the file holds the same street") {
    check_file(street(), build_citystreet(), 60e6);
}
