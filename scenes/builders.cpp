#include "scenes/builders.h"

namespace pluvia {

const std::vector<Builder>& builders() {
    static const std::vector<Builder> all = {
        {"lane", "narrow Japanese alley of timber houses with lanterns and lit windows", build_lane},
        {"citystreet", "city street of brick and stone houses with shops, bare trees and parked cars",
         build_citystreet},
        {"japanesestreet", "Japanese shopping street with lit signs, vending machines, poles and cables",
         build_japanesestreet},
    };
    return all;
}

}  // namespace pluvia
