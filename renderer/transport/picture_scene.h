// What lights the rain in front of a picture: the surfaces that it shows as a scene of their own, placed by depth, with
// bright ones as lamps, and the light from where it shows nothing, estimated from it. Paths that leave a drop meet
// these; the camera itself sees the picture (picture_source.h).
#pragma once

#include "renderer/core/view.h"
#include "renderer/scene/scene.h"
#include "renderer/transport/far_light.h"
#include "renderer/transport/picture_source.h"
#include "shaders/environment.h"

namespace pluvia {

struct PictureSceneSettings {
    /// Cells across the picture's width; each is two triangles.
    int columns = 512;
    /// Surfaces this many times as bright as the picture's mean are lamps: sampled as lights, not only met by chance.
    float lamp_contrast = 10;
    /// Neighbours whose depths differ by more than this factor belong to different objects.
    float largest_step = 1.5f;
};

/// The picture's surfaces in the world of the view; the sky is left out. A cell shows the mean of its pixels.
Scene make_picture_scene(const PictureSource& picture, const View& view, const PictureSceneSettings& settings = {});

/// Light from all around, in cd/m2. In the picture's direction it is the picture without its lamps; beyond its edges it
/// goes on as at the edge, and becomes towards zenith and nadir the mean of the top and bottom rows; behind the camera
/// it is that of the front, mirrored.
Environment estimate_environment(const PictureSource& picture, const View& view,
                                 const PictureSceneSettings& settings = {});

/// What fine rain shows: in the picture's direction the picture without its lamps, elsewhere the environment.
FarLight make_far_light(const PictureSource& picture, const View& view, const Environment& environment,
                        const PictureSceneSettings& settings = {});

}  // namespace pluvia
