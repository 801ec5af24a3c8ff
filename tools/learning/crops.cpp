#include "tools/learning/crops.h"

#include "renderer/core/random.h"
#include "tools/learning/blend.h"

namespace pluvia {
namespace {

constexpr int64_t stored_channels = 10;

/// Where and how a crop is taken: pure functions of (seed, step, place in the batch).
struct Crop {
    size_t pair;
    int64_t x, y;
    bool mirrored, hard, smooth;
};

/// Every fourth crop has a mask that says only where rain is, since masks of other sources say no more.
constexpr int hard_share = 4;
/// Every third crop is smoothed, since photographs have less noise than quick renders.
constexpr int smooth_share = 3;
constexpr int64_t smooth_radius = 2;  // pixels

Crop choose_crop(const std::vector<at::Tensor>& pictures, const TrainingSettings& s, int step, int i) {
    const uint64_t key = hash_key(s.seed, uint64_t(step), uint64_t(i));
    const auto below = [&](uint64_t draw, int64_t n) { return int64_t(unit_double(mix_bits(key + draw)) * double(n)); };
    Crop crop;
    crop.pair = size_t(below(1, int64_t(pictures.size())));
    crop.x = below(2, pictures[crop.pair].size(2) - s.crop + 1);
    crop.y = below(3, pictures[crop.pair].size(1) - s.crop + 1);
    crop.mirrored = below(4, 2) == 1;
    crop.hard = below(5, hard_share) == 0;
    crop.smooth = below(6, smooth_share) == 0;
    return crop;
}

at::Tensor store(const TrainingPair& pair) {
    const int64_t w = pair.background.width, h = pair.background.height, plane = w * h;
    at::Tensor stored = at::empty({stored_channels, h, w}, at::kByte);
    uint8_t* bytes = stored.data_ptr<uint8_t>();
    for (int64_t i = 0; i < plane; ++i) {
        const Rgba8 clean = pair.background.pixels[i], wet = pair.rainy.pixels[i], light = pair.layer.pixels[i];
        const uint8_t values[stored_channels] = {clean.r, clean.g, clean.b, wet.r,   wet.g,
                                                 wet.b,   light.r, light.g, light.b, pair.coverage.pixels[i]};
        for (int64_t c = 0; c < stored_channels; ++c) bytes[c * plane + i] = values[c];
    }
    return stored;
}

}  // namespace

TrainingPictures::TrainingPictures(const std::vector<TrainingPair>& pairs, at::Device device) {
    for (const TrainingPair& pair : pairs) pictures_.push_back(store(pair).to(device));
}

Crops TrainingPictures::take(const TrainingSettings& s, int step) const {
    std::vector<at::Tensor> cut;
    std::vector<float> hard, smooth;
    for (int i = 0; i < s.batch; ++i) {
        const Crop crop = choose_crop(pictures_, s, step, i);
        const at::Tensor part = pictures_[crop.pair].narrow(1, crop.y, s.crop).narrow(2, crop.x, s.crop);
        cut.push_back(crop.mirrored ? part.flip({2}) : part);
        hard.push_back(crop.hard ? 1.0f : 0.0f);
        smooth.push_back(crop.smooth ? 1.0f : 0.0f);
    }
    const at::Tensor all = at::stack(cut).to(at::kFloat);
    const auto of_each = [&](const std::vector<float>& values) {
        return at::tensor(at::ArrayRef<float>(values), at::kFloat).reshape({-1, 1, 1, 1}).to(all.device());
    };
    const at::Tensor clean = all.narrow(1, 0, 3), wet = all.narrow(1, 3, 3), alpha = all.narrow(1, 9, 1);
    constexpr int64_t side = 2 * smooth_radius + 1;
    const at::Tensor blurred =
        at::avg_pool2d(clean, {side, side}, {1, 1}, {smooth_radius, smooth_radius}, false, false);
    const at::Tensor background = at::lerp(clean, blurred, of_each(smooth));
    Crops crops;
    crops.rain = alpha.ge(rain_alpha - 0.5).to(at::kFloat);
    crops.background = background / 127.5 - 1;
    crops.truth = (background + (wet - clean)).clamp(0, 255) / 127.5 - 1;
    crops.streaks = all.narrow(1, 6, 3) * crops.rain / 127.5;
    crops.coverage = at::lerp(alpha / 255, crops.rain, of_each(hard));
    return crops;
}

}  // namespace pluvia
