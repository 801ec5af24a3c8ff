#include "tools/labels/outline.h"

#include <algorithm>
#include <cstdlib>

namespace pluvia {
namespace {

class Regions {
public:
    Regions(const std::vector<uint32_t>& ids, int width)
        : ids_(ids), width_(width), height_(int(ids.size()) / width), region_(ids.size(), -1) {}

    std::vector<Outline> outlines() {
        std::vector<Outline> result;
        // Rows from the top: the first pixel met of a region has no other of it above or to its left.
        for (int y = 0; y < height_; ++y)
            for (int x = 0; x < width_; ++x) {
                if (region_[at(x, y)] >= 0) continue;
                fill(x, y, int(result.size()));
                result.push_back(trace(x, y));
            }
        std::stable_sort(result.begin(), result.end(),
                         [](const Outline& a, const Outline& b) { return a.area > b.area; });
        return result;
    }

private:
    size_t at(int x, int y) const { return size_t(y) * size_t(width_) + size_t(x); }

    void fill(int x0, int y0, int region) {
        const uint32_t id = ids_[at(x0, y0)];
        std::vector<std::array<int, 2>> open = {{x0, y0}};
        region_[at(x0, y0)] = region;
        while (!open.empty()) {
            const auto [x, y] = open.back();
            open.pop_back();
            for (const auto& [dx, dy] : {std::array{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
                const int nx = x + dx, ny = y + dy;
                if (nx < 0 || ny < 0 || nx >= width_ || ny >= height_ || region_[at(nx, ny)] >= 0) continue;
                if (ids_[at(nx, ny)] != id) continue;
                region_[at(nx, ny)] = region;
                open.push_back({nx, ny});
            }
        }
    }

    bool inside(int x, int y, int region) const {
        return x >= 0 && y >= 0 && x < width_ && y < height_ && region_[at(x, y)] == region;
    }

    /// Walks along the edges with the region to the right, from the upper left corner of its first pixel.
    Outline trace(int x0, int y0) const {
        constexpr int dx[] = {1, 0, -1, 0}, dy[] = {0, 1, 0, -1};  // right, down, left, up
        // Of the four pixels at a corner, those ahead to the right and to the left.
        constexpr int right_x[] = {0, -1, -1, 0}, right_y[] = {0, 0, -1, -1};
        constexpr int left_x[] = {0, 0, -1, -1}, left_y[] = {-1, 0, 0, -1};
        const int region = region_[at(x0, y0)];
        Outline outline{ids_[at(x0, y0)], {{x0, y0}}, 0};
        int x = x0, y = y0, direction = 0;
        do {
            x += dx[direction], y += dy[direction];
            int turned = direction;
            if (!inside(x + right_x[direction], y + right_y[direction], region))
                turned = (direction + 1) % 4;
            else if (inside(x + left_x[direction], y + left_y[direction], region))
                turned = (direction + 3) % 4;
            if (turned != direction && (x != x0 || y != y0 || turned != 0)) outline.points.push_back({x, y});
            direction = turned;
        } while (x != x0 || y != y0 || direction != 0);
        int64_t twice = 0;
        for (size_t i = 0; i < outline.points.size(); ++i) {
            const auto &a = outline.points[i], &b = outline.points[(i + 1) % outline.points.size()];
            twice += int64_t(a[0]) * b[1] - int64_t(b[0]) * a[1];
        }
        outline.area = std::abs(twice) / 2;
        return outline;
    }

    const std::vector<uint32_t>& ids_;
    int width_, height_;
    std::vector<int> region_;
};

}  // namespace

std::vector<Outline> outlines(const std::vector<uint32_t>& ids, int width) {
    return Regions(ids, width).outlines();
}

}  // namespace pluvia
