#include "scenes/builders.h"

namespace pluvia {

const std::vector<Builder>& builders() {
    static const std::vector<Builder> all = {
        {"lane", "narrow Japanese alley of timber houses with lanterns and lit windows", build_lane},
        {"citystreet", "city street of brick and stone houses with shops, bare trees and parked cars",
         build_citystreet},
        {"japanesestreet", "Japanese shopping street with lit signs, vending machines, poles and cables",
         build_japanesestreet},
        {"avenue", "wide city street of tall houses, trees and taxis", build_avenue},
        {"terrace", "narrow city street of dwellings with stoops under many trees", build_terrace},
        {"brickyard", "city street of tall brick fronts with fire escapes, without trees", build_brickyard},
        {"backstreet", "narrow Japanese street of small bars", build_backstreet},
        {"stationstreet", "wide Japanese street of tall houses with many signs, without poles", build_stationstreet},
    };
    return all;
}

}  // namespace pluvia
