// The numbers that `pluvia validate compare` knows: names, exact definitions and which side is better.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace pluvia {

enum class Better { low, high, zero };

struct MetricInfo {
    const char* name;
    Better better;
    const char* definition;
};

/// In the order in which they are printed.
const std::vector<MetricInfo>& metric_list();
/// Throws Error (usage) for a name that is not in the list, with why LPIPS and FID are not.
const MetricInfo& metric_info(const std::string& name);

/// Names and definitions as text, a metric per paragraph.
std::string metric_definitions();

/// Values by name, in the order of the list; only those that are defined for the picture.
using Metrics = std::vector<std::pair<std::string, double>>;

/// A limit of --fail.
struct MetricLimit {
    std::string name;
    double value = 0;
};
/// "psnr=30". Throws Error (usage).
MetricLimit parse_limit(const std::string& text);
/// Whether a value is worse than the limit, or not a number.
bool is_worse(const MetricLimit& limit, double value);

}  // namespace pluvia
