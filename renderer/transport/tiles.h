// The pixels of a frame in tiles, by all threads: whole pictures, and passes over them.
#pragma once

#include "renderer/transport/film.h"
#include "renderer/transport/frame_channels.h"

#include <cstdint>
#include <span>
#include <vector>

namespace pluvia {

/// What a PixelRenderer gives, with the samples and the seed of the frame's settings.
std::vector<float> render_pixels(const Frame& frame, std::span<const int64_t> pixels);

/// Adds the samples begin <= i < end of every pixel to the film.
void add_pass(const Frame& frame, Film& film, int begin, int end, const ProgressCallback& progress, Counters& counters);

/// Rows y <= row < y + rows as the samples in the film make them.
Band finished_rows(const Frame& frame, Film& film, const FrameChannels& channels, int y, int rows);

/// All rows to the sink. film: of samples that are taken already; null: they are taken here. Throws Error
/// (stopped_early) when progress returns false, and what the sink throws.
void render_bands(const Frame& frame, Film* film, const FrameChannels& channels, const BandSink& sink,
                  const ProgressCallback& progress, Counters& counters);

}  // namespace pluvia
