#include "renderer/scene/gltf_animation.h"

#include "renderer/core/error.h"
#include "renderer/scene/gltf_accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace pluvia {
namespace {

double length(const std::vector<double>& v) {
    double sum = 0;
    for (const double x : v) sum += x * x;
    return std::sqrt(sum);
}

/// Spherical interpolation of unit quaternions along the shorter arc. Source: glTF 2.0 specification, appendix C.4.
std::vector<double> slerp(const float* a, const float* b, double t) {
    double cosine = 0;
    for (int i = 0; i < 4; ++i) cosine += double(a[i]) * b[i];
    const double sign = cosine < 0 ? -1 : 1, angle = std::acos(std::min(1.0, std::abs(cosine)));
    // Below this the formula divides by the sine of nearly nothing, and the straight line is as exact.
    const bool is_small = angle < 1e-4;
    const double wa = is_small ? 1 - t : std::sin((1 - t) * angle) / std::sin(angle);
    const double wb = sign * (is_small ? t : std::sin(t * angle) / std::sin(angle));
    std::vector<double> q(4);
    for (int i = 0; i < 4; ++i) q[i] = wa * a[i] + wb * b[i];
    return q;
}

}  // namespace

Animations::Animations(const tinygltf::Model& model, const std::string& where, std::vector<std::string>& warnings) {
    std::set<std::pair<int, Path>> animated;
    for (size_t a = 0; a < model.animations.size(); ++a) {
        const tinygltf::Animation& animation = model.animations[a];
        bool is_repeated = false;
        for (size_t c = 0; c < animation.channels.size(); ++c) {
            const tinygltf::AnimationChannel& source = animation.channels[c];
            const std::string channel_where =
                fmt::format("{}: animation {} \"{}\" channel {}", where, a, animation.name, c);
            if (source.target_node == -1) continue;  // the specification leaves these to extensions
            if (source.target_node < 0 || source.target_node >= int(model.nodes.size()))
                throw input_error(channel_where, fmt::format("node does not exist (got {}, expected below {})",
                                                             source.target_node, model.nodes.size()));
            if (source.sampler < 0 || source.sampler >= int(animation.samplers.size()))
                throw input_error(channel_where, fmt::format("sampler does not exist (got {}, expected below {})",
                                                             source.sampler, animation.samplers.size()));
            Path path = Path::translation;
            if (source.target_path == "rotation")
                path = Path::rotation;
            else if (source.target_path == "scale")
                path = Path::scale;
            else if (source.target_path == "weights")
                path = Path::weights;
            else if (source.target_path != "translation") {
                warnings.push_back(
                    fmt::format("animation \"{}\": its channel for \"{}\" is not supported and has no effect",
                                animation.name, source.target_path));
                continue;
            }
            if (!animated.insert({source.target_node, path}).second) {
                is_repeated = true;
                continue;
            }
            channels_.push_back(
                read_channel(model, animation.samplers[source.sampler], source.target_node, path, channel_where));
            const auto& times = channels_.back().times;
            start_ = channels_.size() == 1 ? times.front() : std::min<double>(start_, times.front());
            end_ = std::max<double>(end_, times.back());
        }
        if (is_repeated)
            warnings.push_back(
                fmt::format("animation \"{}\": it moves what an animation before it moves, and only the first "
                            "has an effect there",
                            animation.name));
    }
}

Animations::Channel Animations::read_channel(const tinygltf::Model& model, const tinygltf::AnimationSampler& sampler,
                                             int node, Path path, const std::string& where) const {
    Channel channel{node, path, Interpolation::linear, path == Path::rotation ? 4u : 3u, {}, {}};
    if (sampler.interpolation == "STEP")
        channel.interpolation = Interpolation::step;
    else if (sampler.interpolation == "CUBICSPLINE")
        channel.interpolation = Interpolation::cubic_spline;
    else if (sampler.interpolation != "LINEAR")
        throw input_error(where,
                          fmt::format("its interpolation is unknown (got \"{}\", expected STEP, LINEAR or CUBICSPLINE)",
                                      sampler.interpolation));
    channel.times = read_floats(model, sampler.input, 1, where);
    channel.values = read_floats(model, sampler.output, path == Path::weights ? 1 : int(channel.width), where);
    const size_t keys = channel.times.size(), per_key = channel.interpolation == Interpolation::cubic_spline ? 3 : 1;
    if (keys == 0) throw input_error(where, "has no keys");
    for (size_t i = 0; i < keys; ++i)
        if (channel.times[i] < 0 || (i > 0 && channel.times[i] <= channel.times[i - 1]))
            throw input_error(
                where, fmt::format("accessor {}: its times do not rise (got {} after {} in element {})", sampler.input,
                                   channel.times[i], i > 0 ? channel.times[i - 1] : 0.0f, i));
    if (path == Path::weights) channel.width = channel.values.size() / (keys * per_key);
    if (channel.width == 0 || channel.values.size() != keys * per_key * channel.width)
        throw input_error(
            where,
            fmt::format("accessor {} has the wrong length (got {} numbers, expected {} for each of {} keys)",
                        sampler.output, channel.values.size(), per_key * std::max<size_t>(channel.width, 1), keys));
    return channel;
}

// Source: glTF 2.0 specification, appendix C.
std::vector<double> Animations::sample(const Channel& channel, double time) {
    const auto& times = channel.times;
    const size_t width = channel.width, per_key = channel.interpolation == Interpolation::cubic_spline ? 3 : 1;
    const auto value = [&](size_t key, size_t part = 0) {
        return &channel.values[(key * per_key + (per_key == 3 ? part : 0)) * width];
    };
    const size_t after = size_t(std::upper_bound(times.begin(), times.end(), time) - times.begin());
    const bool is_held = after == 0 || after == times.size() || channel.interpolation == Interpolation::step;
    std::vector<double> result(width);
    if (is_held) {
        const float* held = value(after == 0 ? 0 : after - 1, 1);
        result.assign(held, held + width);
    } else {
        const size_t before = after - 1;
        const double span = double(times[after]) - times[before], t = (time - times[before]) / span;
        if (channel.interpolation == Interpolation::cubic_spline) {
            const float *p0 = value(before, 1), *m0 = value(before, 2), *p1 = value(after, 1), *m1 = value(after, 0);
            const double t2 = t * t, t3 = t2 * t;
            for (size_t i = 0; i < width; ++i)
                result[i] = (2 * t3 - 3 * t2 + 1) * p0[i] + span * (t3 - 2 * t2 + t) * m0[i] +
                            (3 * t2 - 2 * t3) * p1[i] + span * (t3 - t2) * m1[i];
        } else if (channel.path == Path::rotation) {
            result = slerp(value(before), value(after), t);
        } else {
            for (size_t i = 0; i < width; ++i) result[i] = (1 - t) * value(before)[i] + t * value(after)[i];
        }
    }
    if (channel.path == Path::rotation)
        if (const double norm = length(result); norm > 0)
            for (double& x : result) x /= norm;
    return result;
}

void Animations::pose(double time, std::vector<tinygltf::Node>& nodes) const {
    for (const Channel& channel : channels_) {
        tinygltf::Node& node = nodes[channel.node];
        const auto value = sample(channel, time);
        if (channel.path == Path::weights) {
            node.weights = value;
            continue;
        }
        node.matrix.clear();  // a node that is animated has none, says the specification
        (channel.path == Path::translation ? node.translation
         : channel.path == Path::rotation  ? node.rotation
                                           : node.scale) = value;
    }
}

}  // namespace pluvia
