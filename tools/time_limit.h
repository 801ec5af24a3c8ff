// How many samples fit into a time: passes over the picture whose size follows the speed of those before, until what is
// left is what the files need.
#pragma once

#include "renderer/core/view.h"
#include "tools/display_files.h"
#include "tools/frame_file.h"

#include <functional>
#include <string>

namespace pluvia {

/// Seconds of wall-clock time since this process began, the loading of its libraries included.
double process_seconds();

/// Says before each pass over a picture how many samples it takes.
class TimeLimit {
public:
    /// seconds: of everything; now: what has passed of them.
    explicit TimeLimit(double seconds, std::function<double()> now = process_seconds)
        : seconds_(seconds), now_(std::move(now)) {}

    /// Keeps so much time for what comes after the last pass.
    void reserve(double seconds) { reserved_ = seconds; }

    /// Samples of the next pass, 0 when no more fit. The first pass has one, whatever the limit. A pass is expected to
    /// take no more than 2 % of the limit where a sample takes less, so that little is lost when the machine is busy
    /// with other things all of a sudden.
    int next_pass();

private:
    double seconds_;
    std::function<double()> now_;
    double reserved_ = 0, begin_ = 0, per_sample_ = 0;  // seconds
    int asked_ = 0, passes_ = 0;
};

/// Seconds that a frame's files take, measured on some of its rows, which are written to a folder beside them and
/// removed. folder: of the frame's files.
double seconds_to_write(const FrameHeader& header, const std::function<Band(int y, int rows)>& preview,
                        const DisplaySettings& display, const std::string& folder);

}  // namespace pluvia
