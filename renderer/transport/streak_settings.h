// How light of streaks and of the medium of finer rain is found and composed. How it rains is RainSettings.
#pragma once

#include <memory>

namespace pluvia {

class FarLight;
class StreakTextures;

enum class Composition { physical, paper };

struct StreakSettings {
    Composition composition = Composition::physical;
    /// Factor on the light of streaks with the paper's composition. 24.5 is what the paper's published code amounts to
    /// (exposure 1/60 s over its tau0 of 0.68 ms); 1 would be exact.
    double paper_gain = 24.5;
    /// What streaks look like with the paper's composition; null: even.
    std::shared_ptr<const StreakTextures> textures = nullptr;
    /// Light of weight w is computed with probability q = min(1, w L / (c L_background)): this is c. At 0.25 time
    /// times error of the rainy picture is least on wet streets by day, and it has less noise than the clean one.
    double streak_roulette = 0.25, medium_roulette = 0.25;
    /// Light of drops too fine to show where they are comes from drop_light.h; else, and in fog, their paths are
    /// traced.
    bool tabled_veil = false;
    /// What is far around a picture; without it there is no table in front of one.
    std::shared_ptr<const FarLight> far_light = nullptr;
};

}  // namespace pluvia
