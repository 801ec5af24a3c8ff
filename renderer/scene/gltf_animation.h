// Animations of a glTF file: what they make of the nodes at a point of time.
#pragma once

#include <tiny_gltf.h>

#include <string>
#include <vector>

namespace pluvia {

/// All animations of a file, read and checked once. They play at the same time; outside of its keys a channel holds
/// its first or last value. Where several animate the same property of a node the first in the file does.
class Animations {
public:
    /// Throws Error (input) naming animation and channel; what has no effect is named in `warnings`.
    Animations(const tinygltf::Model& model, const std::string& where, std::vector<std::string>& warnings);

    bool empty() const { return channels_.empty(); }
    /// First and last key of all, seconds; 0 when there are none.
    double start() const { return start_; }
    double end() const { return end_; }
    /// Sets translation, rotation, scale and weights of the nodes that are animated. time: seconds.
    void pose(double time, std::vector<tinygltf::Node>& nodes) const;

private:
    enum class Path { translation, rotation, scale, weights };
    enum class Interpolation { step, linear, cubic_spline };
    struct Channel {
        int node;
        Path path;
        Interpolation interpolation;
        size_t width;              // numbers per value: 3, 4, or the number of morph targets
        std::vector<float> times;  // seconds, rising
        std::vector<float> values;
    };
    Channel read_channel(const tinygltf::Model& model, const tinygltf::AnimationSampler& sampler, int node, Path path,
                         const std::string& where) const;
    static std::vector<double> sample(const Channel& channel, double time);

    std::vector<Channel> channels_;
    double start_ = 0, end_ = 0;
};

}  // namespace pluvia
