// What a comparison found, as a table for people and as JSON for programs.
#pragma once

#include "tools/validate/comparison.h"

#include <nlohmann/json.hpp>

namespace pluvia {

/// One pair: metrics by regions. Several: pairs by metrics, a table per region, each with its mean.
std::string compare_table(const std::string& a, const std::string& b, const std::vector<PairResult>& pairs);

/// Everything that is known; numbers that are not finite become null.
nlohmann::ordered_json compare_json(const std::string& a, const std::string& b, const std::vector<PairResult>& pairs);

/// Every value of every pair and region beyond a limit, one line each; empty: all are within.
/// Throws Error (usage) when no pair has the metric.
std::vector<std::string> beyond_limits(const std::vector<PairResult>& pairs, const std::vector<MetricLimit>& limits);

/// A value as the table prints it.
std::string metric_text(const std::string& metric, double value);

}  // namespace pluvia
