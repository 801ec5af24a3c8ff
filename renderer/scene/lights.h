// Lights: one list of everything that shines on a point, sampled with pdfs that a path can weigh against its own.
// Local lights (lamps, emissive triangles) are drawn through the light tree; distant ones are the environment with its
// sun and directional lights.
#pragma once

#include "renderer/core/counters.h"
#include "renderer/scene/light_tree.h"
#include "renderer/scene/surface.h"
#include "shaders/environment.h"

#include <optional>
#include <span>
#include <vector>

namespace pluvia {

/// Light that would arrive at a receiver if nothing were in between.
struct LightSample {
    Vec3 wi;         // towards the light, unit
    float distance;  // metres, infinite for distant lights
    Rgb radiance;    // cd/m2; for delta lights illuminance on a plane facing the light, in lux
    float pdf;       // with respect to solid angle; for delta lights the probability of the choice
    bool delta;      // cannot be met by a ray that was sampled otherwise
};

class Lights {
public:
    Lights(const Scene& scene, const Environment& environment);

    bool has_local() const { return !tree_.empty(); }
    /// Whether they light streets more than the sky does, as at night in a city.
    bool lamps_outshine_sky() const { return lamps_outshine_sky_; }
    bool has_distant() const { return !environment_->is_black() || !directional_.empty(); }
    const Environment& environment() const { return *environment_; }

    /// A point of a local light, and the probability of the choice of the light.
    struct LocalPoint {
        int light;
        Vec2 u;
        float probability;
    };
    /// u_choice picks the light for a receiver, u the point on it. Empty when none reaches it.
    std::optional<LocalPoint> choose_local(const Receiver& receiver, float u_choice, Vec2 u) const;
    /// Several, stratified, for one receiver, with light -1 where none reaches it; their u is left to the caller.
    void choose_local(const Receiver& receiver, float u_choice, std::span<LocalPoint> points) const;
    /// Probability with which choose_local picks this light.
    float choice_probability(const Receiver& receiver, int light) const { return tree_.probability(receiver, light); }
    Vec3 position(const LocalPoint& point) const;
    /// Light from the point to any place; black where it does not shine, and at the point itself.
    LightSample illuminate(Vec3 place, const LocalPoint& point) const;
    /// The same with the mean of the light's texture, which no component is black of where illuminate's is not: enough
    /// to weigh lights against each other.
    LightSample estimate(Vec3 place, const LocalPoint& point) const;

    /// Pdf with respect to solid angle at which choose_local picks this point of an emissive triangle.
    float pdf_local(const Receiver& receiver, const SurfacePoint& point) const;

    /// One distant light; u_choice picks among environment, sun and directional lights.
    std::optional<LightSample> sample_distant(float u_choice, Vec2 u) const;
    /// Pdf with respect to solid angle at which sample_distant picks this direction of the environment.
    float pdf_distant(Vec3 direction) const { return environment_share_ * environment_->pdf(direction); }

    /// The same in two samples: one of the sky, the other of what shines from few directions: sun, moon and
    /// directional lights. That of the sky is Environment::estimate_sky or sky_guide.h.
    bool has_sky() const { return environment_->has_sky(); }
    bool has_sun() const { return environment_->has_sun() || !directional_.empty(); }
    LightSample sample_sun(float u_choice, Vec2 u) const;
    /// Pdf with respect to solid angle at which sample_sun picks this direction of sun and moon. Of the sky it is that
    /// of Environment::sky().
    float pdf_sun(const EnvironmentSample& sun) const { return disc_share_ * sun.pdf; }

private:
    struct EmissiveTriangle {
        int instance, triangle;
        Vec3 corner, edge1, edge2;  // in the scene's coordinates
        Vec3 front;                 // twice the area, on the side that emits
        Rgb mean_emission;
        bool two_sided;

        Vec3 point(float b1, float b2) const { return corner + edge1 * b1 + edge2 * b2; }
    };
    void add_punctual(const PunctualLight& light, std::vector<LightBounds>& all);
    void add_triangles(int instance, std::vector<LightBounds>& all);
    LightSample directional_light(float u_choice, float probability) const;
    LightSample punctual_light(Vec3 place, const PunctualLight& light, float probability) const;
    template <class Emission>
    LightSample triangle_light(Vec3 place, const LocalPoint& point, const Emission& emission) const;

    const Scene* scene_;
    const Environment* environment_;
    std::vector<PunctualLight> punctual_;       // point and spot lights: the first lights of the tree
    std::vector<EmissiveTriangle> triangles_;   // the lights after them
    std::vector<int> first_light_of_instance_;  // index among triangles_, -1 = does not emit
    std::vector<PunctualLight> directional_;
    Distribution1D directional_choice_;
    float environment_share_ = 1;  // probability that sample_distant asks the environment
    float disc_share_ = 1;         // and sample_sun its discs
    LightTree tree_;
    bool lamps_outshine_sky_ = false;
};

}  // namespace pluvia
