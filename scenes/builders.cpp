#include "scenes/builders.h"

namespace pluvia {

const std::vector<Builder>& builders() {
    static const std::vector<Builder> all = {
        {"lane", "narrow Japanese alley of timber houses with lanterns and lit windows", build_lane},
    };
    return all;
}

}  // namespace pluvia
