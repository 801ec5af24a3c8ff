// One pixel of a frame: its camera samples, and the ray through its centre. Frames are put together in render.h.
#pragma once

#include "renderer/transport/camera_ray.h"
#include "renderer/transport/cryptomatte.h"
#include "renderer/transport/dry_parts.h"
#include "renderer/transport/rain_stage.h"
#include "renderer/transport/render.h"

#include <optional>

namespace pluvia {

/// Ids of mattes by index of object and material.
struct FrameMattes {
    const Scene& scene;
    const SceneObjects& objects;
    std::vector<float> object_ids, material_ids;
    float rain_id = cryptomatte_id("rain");

    FrameMattes(const Scene& scene_, const SceneObjects& objects_) : scene(scene_), objects(objects_) {
        for (const LabelObject& object : objects.objects) object_ids.push_back(cryptomatte_id(object.name));
        for (const Material& material : scene.materials) material_ids.push_back(cryptomatte_id(material.name));
    }
};

/// All that the tiles of a frame share.
struct Frame {
    const View& view;
    const RenderSettings& settings;
    const PathTracer& tracer;
    const PictureSource* picture = nullptr;  // in place of camera paths
    float dark = 0;                          // luminance of a picture at which noise does not show, cd/m2
    bool has_medium = false;                 // of fine rain or fog
    const StreakBins* bins = nullptr;        // null where there is no rain
    std::optional<RainStage> rain = std::nullopt;
    const RainShadow* shadow = nullptr;  // of the medium of fine rain; null where there is none
    const LabelTracer* labels = nullptr;
    const FrameMattes* mattes = nullptr;
    Bounds far_scene = {};  // around the scene where the camera is far from it, else empty

    size_t first_label = 0, first_matte = 0;  // places among a pixel's values

    size_t intensity_count() const { return settings.rain.intensities_mm_per_h.size(); }
};

/// What the samples of a pixel add up to.
struct PixelFilm {
    PixelSums sums;
    MatteCounts objects, materials;
};

/// Buffers that live as long as a tile, so that no pixel allocates.
struct PixelScratch {
    PixelFilm film;
    CentreDepth depth;
    std::vector<RainSample> rain;
    RainScratch streaks;
    PixelVeil veil;
    DropLight::Slices drop_light;
    DryPartsOfTile dry;
    std::vector<uint32_t> candidates;  // streaks near the pixel
    StreakBins::Touched touched;       // of them, for some samples
    /// A sample that waits for its rain: paths and rain in turn would displace each other's data in the caches.
    struct RainySample {
        int index;
        CameraSegment segment;
    };
    std::vector<RainySample> rainy;
    std::vector<float> values;
    std::vector<uint32_t> ids;
};

/// Empties the film and finds what the pixel's samples share. Comes before the following.
void begin_pixel(const Frame& frame, int x, int y, PixelScratch& scratch);
/// Adds the samples begin <= i < end to the film.
void add_samples(const Frame& frame, int x, int y, int begin, int end, PixelScratch& scratch, Counters& counters);
/// Depth, and the labels that the same ray finds, the latter into the values behind the layers of light.
void find_centre(const Frame& frame, int x, int y, PixelScratch& scratch, Counters& counters);
/// Coverage by objects, materials and rain, into the values behind the labels. Needs frame.mattes.
void write_mattes(const Frame& frame, PixelScratch& scratch);

}  // namespace pluvia
