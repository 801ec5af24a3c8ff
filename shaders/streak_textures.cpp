#include "shaders/streak_textures.h"

#include "renderer/core/random.h"
#include "shaders/drop_shape.h"

#include <algorithm>
#include <cmath>

namespace pluvia {
namespace {

/// Columns from which on the drop is seen: those with more than a twentieth of the brightest one's light, in all
/// pictures together. The published pictures have a margin.
std::pair<int, int> lit_columns(const StreakDatabase::View& view) {
    std::vector<double> sums(size_t(view.width));
    for (const StreakPicture& picture : view.pictures)
        for (size_t i = 0; i < picture.values.size(); ++i)
            sums[i % size_t(view.width)] += double(picture.values[i]) * picture.factor;
    const double limit = *std::max_element(sums.begin(), sums.end()) / 20;
    int first = 0, last = view.width;
    while (first < last - 1 && sums[size_t(first)] < limit) ++first;
    while (last - 1 > first && sums[size_t(last - 1)] < limit) --last;
    return {first, last};
}

/// Mean of sqrt(1 - u^2) between a and b, -1 to 1.
double mean_chord(double a, double b) {
    const auto integral = [](double u) { return 0.5 * (u * std::sqrt(1 - u * u) + std::asin(u)); };
    return (integral(b) - integral(a)) / (b - a);
}

}  // namespace

StreakPlace streak_place(Vec3 direction, uint64_t key, double diameter, double exposure, float across, float time) {
    StreakPlace place;
    place.across = across;
    place.oscillation = int(hash_key(key, 0x6f7363) % streak_oscillations);
    place.view = nearest_streak_view(std::asin(std::clamp(direction.y, -1.0f, 1.0f)));
    place.up = direction.y > 0 ? -1.0f : 1.0f;
    const Vec3 level(-direction.x, 0, -direction.z);
    const float size = length(level);
    place.toward = size > 1e-6f ? level / size : Vec3(0, 0, 1);
    place.right = cross(Vec3(0, 1, 0), place.toward);
    const double cycles = exposure * oscillation_frequency(2, diameter / 2);
    const double shown = cycles / (streak_exposure * oscillation_frequency(2, streak_diameter / 2));
    const auto share = float(std::min(1.0, shown));
    place.along = unit_float(hash_key(key, 0x73746172)) * (1 - share) + share * time;
    return place;
}

StreakTextures::StreakTextures(StreakDatabase database) : database_(std::move(database)) {
    for (size_t v = 0; v < views_.size(); ++v) {
        const StreakDatabase::View& from = database_.views[v];
        View& view = views_[v];
        const auto [first, last] = lit_columns(from);
        view.left = float(first), view.width = float(last - first);
        // The ends, where the drop comes and goes, are one drop long each.
        view.top = std::min(view.width, 0.4f * float(from.height));
        view.bottom = float(from.height) - view.top;
        double covered = 0;
        for (int x = first; x < last; ++x) {
            const double chord =
                mean_chord(2 * double(x - first) / view.width - 1, 2 * double(x + 1 - first) / view.width - 1);
            view.inverse_chord.push_back(float(1 / chord));
            covered += chord;
        }
        const int top = int(view.top), bottom = std::max(int(view.bottom), top + 1);
        for (const StreakPicture& picture : from.pictures) {
            double sum = 0;
            for (int y = top; y < bottom; ++y)
                for (int x = first; x < last; ++x) sum += picture.values[size_t(y * from.width + x)];
            view.scale.push_back(sum > 0 ? float(covered * (bottom - top) / sum) : 0.0f);
        }
    }
}

float StreakTextures::brightness(const StreakPlace& place, Vec3 wi) const {
    bool mirrored = false;
    const int light = nearest_streak_light({dot(wi, place.right), place.up * wi.y, dot(wi, place.toward)}, &mirrored);
    const View& view = views_[size_t(place.view)];
    const size_t index = size_t(light * streak_oscillations + place.oscillation);
    if (view.scale[index] == 0) return 1;
    const StreakDatabase::View& from = database_.views[size_t(place.view)];
    const float across = std::clamp(mirrored ? -place.across : place.across, -1.0f, 1.0f);
    const float x = std::clamp(0.5f * (across + 1) * view.width - 0.5f, 0.0f, view.width - 1);
    const float y = std::clamp(view.top + place.along * (view.bottom - view.top) - 0.5f, 0.0f, float(from.height - 1));
    const int x0 = int(x), y0 = int(y);
    const int x1 = std::min(x0 + 1, int(view.width) - 1), y1 = std::min(y0 + 1, from.height - 1);
    const auto at = [&](int column, int row) {
        const auto values = from.pictures[index].values.data() + size_t(row) * size_t(from.width);
        return float(values[size_t(int(view.left) + column)]) * view.inverse_chord[size_t(column)];
    };
    const float fx = x - float(x0), fy = y - float(y0);
    return view.scale[index] *
           ((1 - fy) * ((1 - fx) * at(x0, y0) + fx * at(x1, y0)) + fy * ((1 - fx) * at(x0, y1) + fx * at(x1, y1)));
}

}  // namespace pluvia
