// Light that a drop or droplet in the air turns towards the camera: lamps and sky by a light sample and everything else
// by a path that the phase function continues, weighed against each other.
#pragma once

#include "renderer/transport/path.h"
#include "renderer/transport/scatter_function.h"

#include <array>

namespace pluvia {

/// One scattering event. Light that reaches it has not met rain. Made in two steps, so that the costly one can be left
/// to roulette once it is known what the lights may bring.
class ScatteredLight {
public:
    /// distant: sample of sun and sky, which may serve many events; empty: there is none. The sampler's numbers belong
    /// to this event alone. Keeps references.
    ScatteredLight(const PathTracer& tracer, const ScatterFunction& function, Vec3 position,
                   const std::optional<LightSample>& distant, const Sampler& sampler);
    /// How lamps are found: by samples and by paths that meet them, or by samples alone.
    enum class Lamps { and_paths, alone };
    /// Of lamps, for trace_lights().
    ScatteredLight(const PathTracer& tracer, const ScatterFunction& function, Vec3 position, const Sampler& sampler,
                   Lamps lamps = Lamps::alone);

    /// Luminance of the sampled lights if nothing shadows them, in cd/m2.
    float unshadowed() const { return unshadowed_; }
    /// The local light that was sampled, if any, and a weight for it where it is sampled in another way as well.
    const std::optional<Lights::LocalPoint>& lamp() const { return lamp_; }
    void weigh_lamp(float weight);
    /// Unit, towards that lamp.
    Vec3 lamp_direction() const { return candidates_[0].light.wi; }
    /// Radiance towards the camera.
    Rgb trace(const PathWorth& worth, Counters& counters) const {
        return trace_lights(worth, counters) + trace_path(worth, counters);
    }
    /// What the sampled lights bring straight.
    Rgb trace_lights(const PathWorth& worth, Counters& counters) const;

private:
    struct Candidate {
        LightSample light;
        Rgb contribution;  // if the light is visible
        Draw draw;
    };
    void add(const LightSample& light, Draw draw);
    Rgb trace_path(const PathWorth& worth, Counters& counters) const;

    const PathTracer* tracer_;
    const Sampler* sampler_;
    const ScatterFunction* function_;
    Vec3 position_;
    Lamps lamps_;
    std::optional<Lights::LocalPoint> lamp_;  // of the first candidate
    std::array<Candidate, 2> candidates_;
    int count_ = 0;
    float unshadowed_ = 0;
};

}  // namespace pluvia
