#include "scenes/route.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pluvia {
namespace {

constexpr double step = 0.1;      // metres between places
constexpr double straight = 1e9;  // metres: radius of what is not curved

double heading_of(Vec3d way) {
    return std::atan2(way.x, way.z);
}
double flat_length(Vec3d v) {
    return std::hypot(v.x, v.z);
}
/// The turn from one heading to another, within half a turn.
double turn_between(double from, double to) {
    return std::remainder(to - from, 2 * std::numbers::pi);
}

}  // namespace

Route::Route(const std::vector<Vec3d>& corners, const Settings& settings) {
    const size_t n = corners.size();
    double heading = heading_of(corners[0] - corners[n - 1]);
    for (size_t i = 0; i < n; ++i)
        add_corner(corners[(i + n - 1) % n], corners[i], corners[(i + 1) % n], settings.radius, heading);
    // Back to the first place; turned once more or less.
    add(places_.front().position, heading, places_.front().radius);
    set_times(settings);
}

void Route::add(Vec3d position, double heading, double radius) {
    double way = 0;
    if (!places_.empty()) {
        // Straight on from the last place in steps, so that speed can change between them.
        const Place last = places_.back();
        const double far = flat_length(position - last.position);
        const int count = int(std::ceil(far / step));
        for (int k = 1; k < count; ++k) {
            const double s = double(k) / count;
            const bool in_corner = heading != last.heading;
            places_.push_back({last.way + s * far, 0, last.position * (1 - s) + position * s,
                               last.heading * (1 - s) + heading * s, in_corner ? radius : straight, 0});
        }
        way = last.way + far;
    }
    places_.push_back({way, 0, position, heading, radius, 0});
}

void Route::add_corner(Vec3d before, Vec3d corner, Vec3d after, double wanted_radius, double& heading) {
    const Vec3d in = corner - before, out = after - corner;
    const double length_in = flat_length(in), length_out = flat_length(out);
    const double turn = turn_between(heading, heading_of(out)), half = std::tan(std::abs(turn) / 2);
    // From where edges leave the corner's arc. Neighbours need the other half of an edge.
    const double cut = std::min({wanted_radius * half, 0.5 * length_in, 0.5 * length_out});
    if (cut < 1e-6) {  // straight on, at another height
        add(corner, heading, straight);
        return;
    }
    const double radius = cut / half;
    const Vec3d start = corner - Vec3d(in.x, 0, in.z) * (cut / length_in);
    const int count = std::max(2, int(std::ceil(radius * std::abs(turn) / step)));
    for (int k = 0; k <= count; ++k) {
        const double angle = turn * k / count, side = turn > 0 ? 1 : -1;
        // The arc's middle lies to the side to which one turns: +x for a turn from +z on.
        const auto across = [&](double h) { return Vec3d(std::cos(h), 0, -std::sin(h)) * (side * radius); };
        add(start + across(heading) - across(heading + angle), heading + angle, radius);
    }
    heading += turn;
}

void Route::set_times(const Settings& settings) {
    const size_t n = places_.size();
    for (Place& place : places_)
        place.speed = std::min(settings.speed, std::sqrt(settings.acceleration * place.radius));
    const auto limit = [&](size_t i, size_t neighbour, double way) {
        const double v = places_[neighbour].speed;
        places_[i].speed = std::min(places_[i].speed, std::sqrt(v * v + 2 * settings.acceleration * way));
    };
    for (int round = 0; round < 2; ++round) {  // the second knows of what is beyond the start
        for (size_t i = 1; i < n; ++i) limit(i, i - 1, places_[i].way - places_[i - 1].way);
        for (size_t i = n - 1; i-- > 0;) limit(i, i + 1, places_[i + 1].way - places_[i].way);
        places_[0].speed = places_[n - 1].speed = std::min(places_[0].speed, places_[n - 1].speed);
    }
    for (size_t i = 1; i < n; ++i)
        places_[i].time =
            places_[i - 1].time + 2 * (places_[i].way - places_[i - 1].way) / (places_[i].speed + places_[i - 1].speed);
}

RoutePlace Route::at(double seconds) const {
    const double rounds = std::floor(seconds / period()), time = seconds - rounds * period();
    const auto after = std::upper_bound(places_.begin() + 1, places_.end() - 1, time,
                                        [](double t, const Place& place) { return t < place.time; });
    const Place &a = *(after - 1), &b = *after;
    // Speed changes evenly with time between two places.
    const double span = b.time - a.time, t = std::min(time - a.time, span);
    const double gone = span > 0 ? a.speed * t + 0.5 * (b.speed - a.speed) * t * t / span : 0;
    const double s = b.way > a.way ? std::clamp(gone / (b.way - a.way), 0.0, 1.0) : 0;
    const double turned = places_.back().heading - places_.front().heading;
    return {a.position * (1 - s) + b.position * s, a.heading * (1 - s) + b.heading * s + rounds * turned};
}

}  // namespace pluvia
