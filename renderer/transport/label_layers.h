// Label layers: what the ray through the centre of each pixel meets at mid-exposure, as classes, ids and vectors.
// They are never averaged over samples. Mattes, which are, are in cryptomatte.h.
#pragma once

#include "renderer/accel/ray_scene.h"
#include "renderer/core/view.h"
#include "renderer/scene/label_objects.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pluvia {

/// Which layers a frame gets beside those of light and depth.
struct LabelLayers {
    bool semantic = false;     // semantic.ID: class of taxonomy.h, sky included
    bool instance = false;     // instance.ID: LabelObject::id, 0 = none (sky)
    bool normals = false;      // N.X/Y/Z: unit, world axes, shading normal turned to the camera; 0 0 0 for the sky
    bool albedo = false;       // albedo.R/G/B: base colour of the material, linear, 0 to 1; 0 for the sky
    bool position = false;     // position.X/Y/Z: metres in the file's coordinates; +inf for the sky
    bool flow = false;         // flow_fwd.U/V and flow_bwd.U/V with .occlusion: see FlowVisibility
    bool cryptomatte = false;  // CryptoObject, CryptoMaterial, and CryptoRain for each intensity

    bool any_id() const { return semantic || instance; }
    bool any_of_ray() const { return any_id() || normals || albedo || position || flow; }
};

/// flow_fwd.U/V: how many pixels to the right and down the point that a pixel shows is found in the next frame;
/// flow_bwd: in the one before. flow_*.occlusion tells whether it is seen there.
enum class FlowVisibility { visible = 0, hidden = 1, outside = 2, behind = 3 };  // behind the camera: U and V are 0

/// A frame before or after this one: the same instances and triangles elsewhere, or the same scene.
struct OtherFrame {
    std::shared_ptr<const Scene> scene;  // null: the scene of the frame itself, in which nothing moves
    View view;
};

/// What labels are made from. Scenes, objects and views belong to the caller.
struct LabelSettings {
    LabelLayers layers;
    std::shared_ptr<const SceneObjects> objects;  // of the frame's scene
    std::optional<OtherFrame> next, previous;     // with layers.flow
};

/// Channels in the order in which LabelTracer writes them: float ones and ids.
std::vector<std::string> label_channels(const LabelLayers& layers);
std::vector<std::string> label_id_channels(const LabelLayers& layers);

class LabelTracer {
public:
    /// Keeps references.
    LabelTracer(const Scene& scene, const RayScene& ray_scene, const View& view, const LabelSettings& settings);
    ~LabelTracer();

    /// direction: of the centre ray, world, unit. hit: null for the sky. values, ids: as many as there are channels.
    void write(Vec3 direction, const RayHit* hit, float* values, uint32_t* ids, Counters& counters) const;

private:
    struct Other;
    void write_flow(const Other& other, Vec3d world, Vec3 direction, const RayHit* hit, float* values,
                    Counters& counters) const;

    const Scene& scene_;
    const View& view_;
    const LabelSettings& settings_;
    std::vector<std::unique_ptr<Other>> others_;  // next and previous
};

}  // namespace pluvia
