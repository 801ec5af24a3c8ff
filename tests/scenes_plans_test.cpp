// The streets by other plans are whole, as scene_checks.h has it, and differ in more than colour.
#include "scenes/builders.h"
#include "tests/scene_checks.h"

#include <doctest/doctest.h>

#include <cmath>
#include <set>

using namespace pluvia;

TEST_CASE("five more streets are whole, and no two are as wide or as high") {
    struct Plan {
        const char* name;
        Scene (*build)();
        bool has_trees, has_cars;
    };
    std::set<int> heights;
    for (const Plan& plan : {Plan{"avenue", build_avenue, true, true},
                             {"terrace", build_terrace, true, true},
                             {"brickyard", build_brickyard, false, true},
                             {"backstreet", build_backstreet, false, false},
                             {"stationstreet", build_stationstreet, false, false}}) {
        CAPTURE(plan.name);
        const Scene scene = plan.build();
        CHECK(scene.name == plan.name);
        const size_t placed = placed_triangles(scene);
        CAPTURE(placed);
        CHECK(placed >= 500000);
        CHECK(placed <= 5000000);
        check_pictures(scene);
        check_vertices(scene);
        check_triangles(scene);
        check_cameras(scene, {"front", "back", "sideleft", "sideright"});
        check_classes(scene, {"road", "sidewalk", "building", "pole", "static"});
        check_lamps(scene, 20, 20000);
        bool trees = false, cars = false;
        for (const Instance& i : scene.instances) {
            trees = trees || (i.semantic == "vegetation" && i.name.find("/tree_") != std::string::npos);
            cars = cars || i.semantic == "car";
        }
        CHECK(trees == plan.has_trees);
        CHECK(cars == plan.has_cars);
        heights.insert(int(std::lround(10 * bounds(scene).upper.y)));
    }
    CHECK(heights.size() == 5);
}
