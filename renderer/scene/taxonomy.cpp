#include "renderer/scene/taxonomy.h"

#include <algorithm>
#include <cctype>

namespace pluvia {

// Sources: cityscapesScripts, labels.py; CARLA's sensor reference for 0.9.14 and its pull request 3251 for what came
// before; COCO panoptic categories; KITTI's object devkit.
const std::vector<LabelClass>& taxonomy() {
    static const std::vector<LabelClass> classes = {
        // name, id, Cityscapes id, train id, countable, colour, CARLA tags, COCO id and name, thing, KITTI type
        {"unlabeled", 0, 0, 255, false, {0, 0, 0}, 0, 0, 0, "", false, ""},
        {"ego vehicle", 1, 1, 255, false, {0, 0, 0}, 0, 0, 0, "", false, ""},
        {"rectification border", 2, 2, 255, false, {0, 0, 0}, 0, 0, 0, "", false, ""},
        {"out of roi", 3, 3, 255, false, {0, 0, 0}, 0, 0, 0, "", false, ""},
        {"static", 4, 4, 255, false, {0, 0, 0}, 20, 19, 0, "", false, ""},
        {"dynamic", 5, 5, 255, false, {111, 74, 0}, 21, 20, 0, "", false, ""},
        {"ground", 6, 6, 255, false, {81, 0, 81}, 25, 14, 0, "", false, ""},
        {"road", 7, 7, 0, false, {128, 64, 128}, 1, 7, 149, "road", false, ""},
        {"sidewalk", 8, 8, 1, false, {244, 35, 232}, 2, 8, 191, "pavement-merged", false, ""},
        {"parking", 9, 9, 255, false, {250, 170, 160}, 25, 14, 191, "pavement-merged", false, ""},
        {"rail track", 10, 10, 255, false, {230, 150, 140}, 27, 16, 147, "railroad", false, ""},
        {"building", 11, 11, 2, false, {70, 70, 70}, 3, 1, 197, "building-other-merged", false, ""},
        {"wall", 12, 12, 3, false, {102, 102, 156}, 4, 11, 199, "wall-other-merged", false, ""},
        {"fence", 13, 13, 4, false, {190, 153, 153}, 5, 2, 185, "fence-merged", false, ""},
        {"guard rail", 14, 14, 255, false, {180, 165, 180}, 28, 17, 185, "fence-merged", false, ""},
        {"bridge", 15, 15, 255, false, {150, 100, 100}, 26, 15, 95, "bridge", false, ""},
        {"tunnel", 16, 16, 255, false, {150, 120, 90}, 3, 1, 197, "building-other-merged", false, ""},
        {"pole", 17, 17, 5, false, {153, 153, 153}, 6, 5, 0, "", false, ""},
        {"polegroup", 18, 18, 255, false, {153, 153, 153}, 6, 5, 0, "", false, ""},
        {"traffic light", 19, 19, 6, false, {250, 170, 30}, 7, 18, 10, "traffic light", true, ""},
        {"traffic sign", 20, 20, 7, false, {220, 220, 0}, 8, 12, 0, "", false, ""},
        {"vegetation", 21, 21, 8, false, {107, 142, 35}, 9, 9, 184, "tree-merged", false, ""},
        {"terrain", 22, 22, 9, false, {152, 251, 152}, 10, 22, 193, "grass-merged", false, ""},
        {"sky", 23, 23, 10, false, {70, 130, 180}, 11, 13, 187, "sky-other-merged", false, ""},
        {"person", 24, 24, 11, true, {220, 20, 60}, 12, 4, 1, "person", true, "Pedestrian"},
        {"rider", 25, 25, 12, true, {255, 0, 0}, 13, 4, 1, "person", true, "Cyclist"},
        {"car", 26, 26, 13, true, {0, 0, 142}, 14, 10, 3, "car", true, "Car"},
        {"truck", 27, 27, 14, true, {0, 0, 70}, 15, 10, 8, "truck", true, "Truck"},
        {"bus", 28, 28, 15, true, {0, 60, 100}, 16, 10, 6, "bus", true, "Misc"},
        {"caravan", 29, 29, 255, true, {0, 0, 90}, 15, 10, 8, "truck", true, "Misc"},
        {"trailer", 30, 30, 255, true, {0, 0, 110}, 15, 10, 8, "truck", true, "Misc"},
        {"train", 31, 31, 16, true, {0, 80, 100}, 17, 10, 7, "train", true, "Tram"},
        {"motorcycle", 32, 32, 17, true, {0, 0, 230}, 18, 10, 4, "motorcycle", true, "Misc"},
        {"bicycle", 33, 33, 18, true, {119, 11, 32}, 19, 10, 2, "bicycle", true, "Misc"},
        // What Cityscapes does not tell apart.
        {"road line", 34, 7, 0, false, {157, 234, 50}, 24, 6, 149, "road", false, ""},
        {"water", 35, 6, 255, false, {45, 60, 150}, 23, 21, 178, "water-other", false, ""},
    };
    return classes;
}

int class_id(std::string_view name) {
    const auto letter = [](char c) {
        return c == '_' || c == '-' ? ' ' : char(std::tolower(static_cast<unsigned char>(c)));
    };
    for (const LabelClass& c : taxonomy())
        if (std::equal(name.begin(), name.end(), c.name.begin(), c.name.end(),
                       [&](char a, char b) { return letter(a) == b; }))
            return c.id;
    return -1;
}

}  // namespace pluvia
