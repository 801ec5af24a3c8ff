// Taxonomy: the classes that labels know, and what other datasets call each of them. The one table of it is in
// taxonomy.cpp; ids are only ever looked up there, never derived from colours, which several classes share.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace pluvia {

/// A class of things or surfaces.
struct LabelClass {
    std::string_view name;  // as Cityscapes has it where it has the class
    /// Of semantic.ID. That of Cityscapes, 0 to 33, where it has the class; others follow from 34 on. 0 = unlabeled.
    int id;
    int cityscapes_id;             // 0 to 33; of the class that comes nearest where Cityscapes lacks it
    int train_id;                  // of Cityscapes: 0 to 18, 255 = ignored
    bool countable;                // Cityscapes tells instances of it apart
    std::array<uint8_t, 3> color;  // of Cityscapes' palette; for the eye only
    int carla_tag;                 // CARLA 0.9.14 and later, 0 to 28
    int carla_tag_before_0_9_14;   // CARLA 0.9.10 to 0.9.13, 0 to 22
    int coco_id;                   // category of COCO panoptic, 1 to 200; 0 = none
    std::string_view coco_name;    // empty where there is none
    bool coco_thing;               // COCO counts instances of it
    std::string_view kitti_type;   // of KITTI's label_2; empty where it has none
};

/// All classes in the order of their ids, which are 0, 1, 2, ...
const std::vector<LabelClass>& taxonomy();

constexpr int unlabeled_id = 0, sky_id = 23;

/// -1 where there is no such class. Case, and '_' or '-' for a space, do not matter.
int class_id(std::string_view name);

}  // namespace pluvia
