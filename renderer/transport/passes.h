// render() with samples that come in passes over the whole picture, so that a caller may stop when it has enough.
#pragma once

#include "renderer/transport/render.h"

namespace pluvia {

/// Finished rows y <= row < y + rows of the picture as the samples taken so far make it.
using BandPreview = std::function<Band(int y, int rows)>;
/// Asked before each pass how many samples per pixel it takes, 0: no more are wanted. done: those taken so far; the
/// first answer is above 0.
using NextPass = std::function<int(int done, const BandPreview& preview)>;

/// The picture of render() with as many samples as the passes have in sum, to the byte. Their sums stay in memory:
/// about 100 bytes a pixel, and as many for each intensity. settings.samples and choose_samples are not asked.
RenderReport render_in_passes(const Scene& scene, const Environment& environment, const View& view,
                              const RenderSettings& settings, const NextPass& next_pass, const BandSink& sink,
                              const ProgressCallback& progress);

}  // namespace pluvia
