#include "renderer/transport/shelter.h"

#include "renderer/core/parallel.h"

namespace pluvia {

void remove_sheltered(std::vector<Streak>& streaks, const View& view, const RayScene& ray_scene, Counters& counters) {
    constexpr int block = 1024;
    const int blocks = int((streaks.size() + block - 1) / block);
    std::vector<char> sheltered(streaks.size());
    std::vector<Counters> block_counters(blocks);
    parallel_for(blocks, [&](int b) {
        for (size_t i = size_t(b) * block; i < std::min(streaks.size(), size_t(b + 1) * block); ++i) {
            const Streak& s = streaks[i];
            const Vec3 middle = s.start + s.velocity * float(view.exposure_time / 2);
            const Vec3d from_camera = view.world_vector_from_view(Vec3d(middle)),
                        position = view.position + from_camera;
            const Vec3d fall = view.world_vector_from_view(Vec3d(s.velocity)) + view.velocity +
                               cross(view.angular_velocity, from_camera);
            // Leaves let half of the drops through that they let half of the light through.
            const Ray upwards{Vec3(position), -Vec3(normalize(fall))};
            sheltered[i] = ray_scene.occluded(upwards, {s.key}, block_counters[b]);
        }
    });
    for (const Counters& c : block_counters) counters += c;
    size_t kept = 0;
    for (size_t i = 0; i < streaks.size(); ++i)
        if (!sheltered[i]) streaks[kept++] = streaks[i];
    streaks.resize(kept);
}

}  // namespace pluvia
