// What accuracy costs, as a table, as JSON and as a page with plots.
#pragma once

#include "tools/validate/trade.h"

#include <string>
#include <vector>

namespace pluvia {

std::string trade_table(const TradeReport& report);

/// Everything; results can be read again by trade_results().
nlohmann::ordered_json trade_json(const TradeReport& report);
/// Those of an earlier report. Throws nlohmann::json::exception when it is none.
std::vector<TradeResult> trade_results(const nlohmann::ordered_json& json);

/// One page that needs no other file.
std::string trade_page(const TradeReport& report);

}  // namespace pluvia
