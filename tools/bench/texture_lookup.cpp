// Time of a texture look-up: pictures held whole in 8 bits and looked up bilinearly, as Pluvia does, against
// OpenImageIO's TextureSystem on tiled pyramids of the same pictures, all of them in its cache. Prints a table; no
// options. Look-ups are those of camera rays (from texel to texel) and those of scattered ones (any texel of any
// picture). An eighth of a picture as footprint is the level that a pyramid would take for light scattered all around.
//   cmake --build build --target texture_lookup
#include "renderer/core/parallel.h"
#include "renderer/core/random.h"
#include "renderer/scene/texture.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/texture.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>

using namespace pluvia;

namespace {

constexpr int pictures = 24, side = 1024, batches = 64, lookups = 1 << 15;  // of a batch

/// One after the other along rows of a picture, half a texel apart; or anywhere.
struct Place {
    int texture;
    Vec2 uv;
};

Place place(bool scattered, int batch, int i) {
    const uint64_t key = hash_key(5, batch, scattered ? i : 0);
    const auto texture = int(key % pictures);
    if (scattered) return {texture, {unit_float(mix_bits(key)), unit_float(mix_bits(key + 1))}};
    return {texture, {0.1f + float(i % 256) * 0.5f / side, 0.1f + float(i / 256) * 0.5f / side}};
}

Scene noise_pictures() {
    Scene scene;
    for (int k = 0; k < pictures; ++k) {
        Image<Rgba8> image(side, side);
        for (size_t i = 0; i < image.pixels.size(); ++i) {
            const uint64_t bits = hash_key(uint64_t(k), i);
            image.pixels[i] = {uint8_t(bits), uint8_t(bits >> 8), uint8_t(bits >> 16), 255};
        }
        scene.images.push_back(std::move(image));
        Texture texture;
        texture.image = k;
        scene.textures.push_back(texture);
    }
    return scene;
}

std::vector<std::string> write_pyramids(const Scene& scene, const std::string& folder) {
    std::vector<std::string> paths;
    for (const Image<Rgba8>& image : scene.images) {
        const OIIO::ImageBuf buffer(OIIO::ImageSpec(side, side, 4, OIIO::TypeDesc::UINT8),
                                    const_cast<Rgba8*>(image.pixels.data()));
        paths.push_back(folder + "/" + std::to_string(paths.size()) + ".tx");
        if (OIIO::ImageBufAlgo::make_texture(OIIO::ImageBufAlgo::MakeTxTexture, buffer, paths.back(), {})) continue;
        std::fprintf(stderr, "texture_lookup: %s: %s\n", paths.back().c_str(), OIIO::geterror().c_str());
        std::exit(4);
    }
    return paths;
}

/// Prints nanoseconds per look-up and thread, the least of five runs, and the mean of what was read. look: gives the
/// sum of what it reads in a batch.
void report(const char* name, bool scattered, const std::function<double(bool scattered, int batch)>& look) {
    for (int threads : {1, 2}) {
        set_thread_count(threads);
        double best = 1e30, mean = 0;
        for (int repeat = 0; repeat < 5; ++repeat) {
            std::vector<double> sums(batches);
            const auto begin = std::chrono::steady_clock::now();
            parallel_for(batches, [&](int batch) { sums[size_t(batch)] = look(scattered, batch); });
            const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
            best = std::min(best, took.count() * threads / batches / lookups);
            mean = 0;
            for (double sum : sums) mean += sum / batches / lookups;
        }
        std::printf("%-28s %-10s %7d %8.1f %8.4f\n", name, scattered ? "scattered" : "camera", threads, best * 1e9,
                    mean);
    }
}

}  // namespace

int main() {
    const Scene scene = noise_pictures();
    const std::string folder = std::filesystem::temp_directory_path() / "texture_lookup";
    std::filesystem::create_directories(folder);
    const std::vector<std::string> paths = write_pyramids(scene, folder);

    OIIO::TextureSystem* const system = OIIO::TextureSystem::create(false);
    system->attribute("max_memory_MB", 4096.0f);
    std::vector<OIIO::TextureSystem::TextureHandle*> handles;
    for (const std::string& path : paths) handles.push_back(system->get_texture_handle(OIIO::ustring(path)));
    const auto look_oiio = [&](OIIO::TextureOpt::MipMode mip, float footprint) {
        return [&, mip, footprint](bool scattered, int batch) {
            OIIO::TextureSystem::Perthread* const thread = system->get_perthread_info();
            OIIO::TextureOpt options;
            options.swrap = options.twrap = OIIO::TextureOpt::WrapPeriodic;
            options.interpmode = OIIO::TextureOpt::InterpBilinear;
            options.mipmode = mip;
            double sum = 0;
            for (int i = 0; i < lookups; ++i) {
                const Place p = place(scattered, batch, i);
                float value[3];
                system->texture(handles[size_t(p.texture)], thread, options, p.uv.x, p.uv.y, footprint, 0, 0, footprint,
                                3, value);
                sum += value[0];
            }
            return sum;
        };
    };

    std::printf("%d pictures of %d x %d\n%-28s %-10s %7s %8s %8s\n", pictures, side, side, "", "look-ups", "threads",
                "ns", "mean");
    for (bool scattered : {false, true}) {
        report("places alone", scattered, [](bool s, int batch) {
            double sum = 0;
            for (int i = 0; i < lookups; ++i) sum += double(place(s, batch, i).uv.x);
            return sum;
        });
        report("Pluvia, bilinear", scattered, [&](bool s, int batch) {
            double sum = 0;
            for (int i = 0; i < lookups; ++i) {
                const Place p = place(s, batch, i);
                sum += double(lookup_linear(scene, p.texture, p.uv).x);
            }
            return sum;
        });
        report("OpenImageIO, no pyramid", scattered, look_oiio(OIIO::TextureOpt::MipModeNoMIP, 0));
        report("OpenImageIO, one level", scattered, look_oiio(OIIO::TextureOpt::MipModeOneLevel, 0.125f));
        report("OpenImageIO, two levels", scattered, look_oiio(OIIO::TextureOpt::MipModeTrilinear, 0.125f));
    }
    OIIO::TextureSystem::destroy(system);
    std::filesystem::remove_all(folder);
}
