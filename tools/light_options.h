// Options that decide over the light: the sky of a time and place, or a picture in its stead, and the lamps.
#pragma once

#include "shaders/moon_position.h"
#include "shaders/sky.h"
#include "shaders/sun_position.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <optional>
#include <string>

namespace pluvia {

/// In the units of the command line.
struct LightOptions {
    double hour = 12;
    std::string date = "2024-09-22";
    double latitude = 35.7, longitude = 139.7, utc_offset = 9;  // Tokyo
    std::optional<double> sun_elevation, sun_azimuth;           // degrees
    std::string weather;                                        // empty: rain where it rains, else clear
    std::optional<double> cloud_cover;                          // of the weather where empty, as the next
    std::string cloud_type;
    std::string city_glow = "none";  // name, or cd/m2
    double turbidity = 3.2;          // the aerosol of AtmosphereSettings
    std::string environment;         // empty: the sky
    double environment_scale = 1;
    std::optional<double> environment_illuminance;
    std::string lamps = "auto";
    int sky_texels = SkySettings().texels;  // no option: `validate trade` shows that nobody needs one
};

/// Those of the sky alone, and those of any environment and the lamps of a scene.
void add_sky_options(CLI::App& command, LightOptions& options);
void add_light_options(CLI::App& command, LightOptions& options);

/// The air, and what stands in it at a time. rains: whether it rains in the picture; with no word about weather the sky
/// is then that of rain. Throw Error (usage) naming the option, what was given and what is expected.
AtmosphereSettings atmosphere_settings(const LightOptions& options);
SkySettings sky_settings(const LightOptions& options, bool rains);

/// The light that --environment or hour, place and weather ask for; says on stderr when rain decides over the weather.
/// Throws as the above, before it computes anything.
Environment make_environment(const LightOptions& options, bool rains);

/// Whether the lamps of a scene are on: as told, or by the light of the environment. Lamps of streets are switched on
/// when daylight falls to 20 to 70 lux.
bool lamps_are_on(const LightOptions& options, const Environment& environment);

/// Adds the options that decide over the light, with their values.
void add_json(nlohmann::ordered_json& json, const LightOptions& options, bool rains);

}  // namespace pluvia
