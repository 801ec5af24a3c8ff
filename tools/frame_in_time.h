// render_frame() with as many samples as a time has room for; beside it in frame_render.cpp.
#pragma once

#include "tools/frame_render.h"

namespace pluvia {

/// seconds: since the process began (tools/time_limit.h), with those that the files of write_display_files() take. The
/// header says how many samples they were; the files are those of --spp with that number. Uses a folder time-limit.tmp
/// beside the file.
RenderedFrame render_frame_in_time(FrameScene scene, const RenderOptions& options, const FrameSettings& settings,
                                   const std::string& exr, double seconds, const ProgressCallback& progress);

}  // namespace pluvia
