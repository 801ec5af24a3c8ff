// The bodies of glass or water that a path is in. Light is absorbed in the innermost, by Beer and Lambert; its index is
// the one that the next surface bends against. A path enters where it passes a front and leaves where it passes a back,
// so bodies may lie in each other, and a hollow is one whose fronts look into it. Bodies that overlap bend light at
// faces that a real pair would not have. A path that begins inside a body finds out where it leaves.
#pragma once

#include "renderer/scene/surface.h"

#include <array>

namespace pluvia {

class Media {
public:
    bool empty() const { return depth_ == 0; }
    /// Material of the innermost body, -1 = air.
    int innermost() const { return depth_ > 0 ? stack_[depth_ - 1] : -1; }
    bool contains(int material) const;

    /// Deeper than eight bodies none is entered.
    void enter(int material);
    /// No effect where the path is not in it.
    void leave(int material);

private:
    std::array<int, 8> stack_;
    int depth_ = 0;
};

/// What of light is left after `distance` metres in a body; 1 in air (material -1).
Rgb transmittance(const Scene& scene, int material, float distance);

/// 1 / n^2 of a body: takes radiance inside of it to basic radiance (shaders/glass.h); 1 in air.
float basic_radiance(const Scene& scene, int material);

/// Finds what lies before and behind a surface that the path has just met, and with it the index of glass.
void find_sides(const Scene& scene, const Media& media, Surface& surface);

}  // namespace pluvia
