// Rules that give classes to nodes by the names that these have, for scenes whose files do not; from a YAML file:
//   - nodes: "(car_[a-z]+).*"   # regular expression that a node's whole path matches, "street/car_taxi"
//     class: car                # as Cityscapes names it
//     object: "$1"              # optional: nodes with the same are one object; $1 is what the first group matched
// An expression is ECMAScript's without references back to groups and without looking ahead (label_pattern.h).
// A rule holds for all nodes below those that match, unless another matches nearer; of several the first holds.
#pragma once

#include "renderer/scene/label_objects.h"

#include <string>
#include <vector>

namespace pluvia {

/// Throws Error: input when the file cannot be read, usage with FILE:LINE for what is wrong in it.
std::vector<LabelRule> read_label_rules(const std::string& path);

}  // namespace pluvia
