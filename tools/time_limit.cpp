#include "tools/time_limit.h"

#include "tools/clock.h"

#include <unistd.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace pluvia {
namespace {

/// Field 22 of /proc/self/stat, after the name in parentheses, which may hold spaces: see proc(5).
double process_start() {
    std::ifstream file("/proc/self/stat");
    std::string text;
    std::getline(file, text);
    std::istringstream fields(text.substr(std::min(text.size(), text.rfind(')') + 1)));
    std::string field;
    for (int i = 3; i <= 22; ++i) fields >> field;
    return fields ? std::strtod(field.c_str(), nullptr) / double(sysconf(_SC_CLK_TCK)) : clock_seconds(CLOCK_BOOTTIME);
}

}  // namespace

double process_seconds() {
    static const double start = process_start();
    return clock_seconds(CLOCK_BOOTTIME) - start;
}

int TimeLimit::next_pass() {
    const double now = now_();
    int samples = 1;
    if (asked_ > 0) {
        const double measured = (now - begin_) / asked_;
        // A slow pass is believed at once, a quick one may have been luck. The first finds for all what is sheltered,
        // which says nothing about the others.
        per_sample_ = passes_ <= 2 ? measured : std::max(measured, 0.5 * (measured + per_sample_));
        const double left = seconds_ - reserved_ - now;
        const double wanted = std::min(left, 0.02 * seconds_) / per_sample_;
        samples = wanted >= 1 ? int(std::min(wanted, 4.0 * asked_)) : left >= 1.1 * per_sample_ ? 1 : 0;
    }
    asked_ = samples;
    ++passes_;
    begin_ = now_();
    return samples;
}

double seconds_to_write(const FrameHeader& header, const std::function<Band(int y, int rows)>& preview,
                        const DisplaySettings& display, const std::string& folder) {
    const double begin = process_seconds();
    const std::string trial = folder + "/time-limit.tmp";
    const int height = header.view.height, rows = std::min(height, std::max(16, height / 16));
    FrameHeader part = header;
    part.view.height = rows;
    {
        Band band = preview((height - rows) / 2, rows);
        band.y = 0;
        FrameWriter writer(trial + "/frame.exr", part);
        writer.write(band);
        writer.finish(0);
    }
    write_display_files(trial, trial + "/frame.exr", header.intensities, display);
    std::error_code ignored;  // what is left of it stands in nobody's way
    std::filesystem::remove_all(trial, ignored);
    return (process_seconds() - begin) * height / rows;
}

}  // namespace pluvia
