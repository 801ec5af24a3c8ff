#include "tools/learning/tiled.h"

namespace pluvia {

at::Tensor cut(const at::Tensor& frame, const TilePlan& plan, int cell, int x, int y) {
    return frame.narrow(2, y / cell, plan.y.size / cell).narrow(3, x / cell, plan.x.size / cell).contiguous();
}

at::Tensor over_tiles(const TilePlan& plan, int out_cell, bool backwards, TileCount& count,
                      const std::function<at::Tensor(int x, int y)>& body) {
    struct Place {
        int x, y;
        at::Tensor answer;
    };
    std::vector<Place> places;
    for (const int y : plan.y.positions)
        for (const int x : plan.x.positions) places.push_back({x, y, {}});
    for (size_t i = 0; i < places.size(); ++i) {
        Place& place = places[backwards ? places.size() - 1 - i : i];
        place.answer = body(place.x, place.y);
        count.next();
    }
    const auto options = places.front().answer.options();
    const auto as_tensor = [&](const std::vector<float>& w) {
        return at::tensor(at::ArrayRef<float>(w), at::kFloat).to(options.device());
    };
    const at::Tensor weight =
        as_tensor(plan.y.weights(out_cell)).unsqueeze(1) * as_tensor(plan.x.weights(out_cell)).unsqueeze(0);
    const int64_t height = plan.y.padded / out_cell, width = plan.x.padded / out_cell;
    at::Tensor sum = at::zeros({1, places.front().answer.size(1), height, width}, options),
               weights = at::zeros({1, 1, height, width}, options);
    for (const Place& place : places) {
        const auto there = [&](const at::Tensor& t) {
            return t.narrow(2, place.y / out_cell, weight.size(0)).narrow(3, place.x / out_cell, weight.size(1));
        };
        there(sum).add_(place.answer * weight);
        there(weights).add_(weight);
    }
    return sum / weights;
}

}  // namespace pluvia
