// The bands of a frame while threads fill them, and what is told of the progress.
#pragma once

#include "renderer/core/error.h"
#include "renderer/core/view.h"
#include "renderer/transport/frame_channels.h"
#include "renderer/transport/render.h"

#include <atomic>
#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>

namespace pluvia {

/// Counts finished pixels and passes the news on. Whoever comes while another thread tells it goes on.
class PixelProgress {
public:
    PixelProgress(const View& view, const ProgressCallback& callback)
        : pixels_(double(view.width) * view.height), callback_(callback) {}

    void add_pixel() {
        const double done = double(++done_) / pixels_;
        const std::unique_lock lock(mutex_, std::try_to_lock);
        if (lock && !callback_(done))
            throw Error(ExitCode::stopped_early, "render", "stopped before the end, nothing was written");
    }

private:
    double pixels_;
    const ProgressCallback& callback_;
    std::atomic<int64_t> done_ = 0;
    std::mutex mutex_;
};

/// Bands in work; each leaves for the sink when it and all before it are complete. One thread at a time writes, outside
/// the lock, while the others go on rendering; they wait before they get too far ahead of it.
class BandQueue {
public:
    BandQueue(const View& view, int tile_size, const FrameChannels& channels, const BandSink& sink)
        : view_(view),
          tile_size_(tile_size),
          columns_((view.width + tile_size - 1) / tile_size),
          channels_(channels),
          sink_(sink) {}

    int columns() const { return columns_; }

    /// The band of a row of tiles. Rows are asked for in rising order, so that those that others wait for are in work.
    Band& band(int row) {
        std::unique_lock lock(mutex_);
        // Counted in rows: a thread that comes late for the row that all wait for finds its place free.
        written_.wait(lock, [&] { return stopped_ || row < next_row_ + max_open_bands; });
        auto& entry = bands_[row];
        if (!entry.band) {
            const int y = row * tile_size_;
            entry.band = std::make_unique<Band>(y, std::min(tile_size_, view_.height - y), view_.width,
                                                channels_.values.size(), channels_.ids.size());
        }
        return *entry.band;
    }

    void complete_tile(int row) {
        std::unique_lock lock(mutex_);
        ++bands_[row].tiles_done;
        if (writing_) return;
        writing_ = true;
        while (!bands_.empty() && bands_.begin()->first == next_row_ && bands_.begin()->second.tiles_done == columns_) {
            const std::unique_ptr<Band> band = std::move(bands_.begin()->second.band);
            lock.unlock();
            sink_(*band);
            lock.lock();
            bands_.erase(bands_.begin());
            ++next_row_;
            written_.notify_all();
        }
        writing_ = false;
    }

    /// Lets waiting threads go after a failure.
    void stop() {
        const std::lock_guard lock(mutex_);
        stopped_ = true;
        written_.notify_all();
    }

private:
    static constexpr int max_open_bands = 16;
    struct Entry {
        std::unique_ptr<Band> band;
        int tiles_done = 0;
    };
    const View& view_;
    int tile_size_, columns_;
    FrameChannels channels_;
    const BandSink& sink_;
    std::mutex mutex_;
    std::condition_variable written_;
    std::map<int, Entry> bands_;
    int next_row_ = 0;
    bool writing_ = false, stopped_ = false;
};

}  // namespace pluvia
