// The project's OpenColorIO configuration: scene-linear Rec.709 and the views that color.h offers, without LUT files.
// Saved as config.ocio it shows the same pictures in other programs that use OpenColorIO 2.1 or later.
#pragma once

namespace pluvia {

// The filmic view is its own: a log2 shaper from 10 stops below 0.18 to 6.5 above (16.3 times display white), then a
// curve through (x0, 1/2), where x0 = 10 / 16.5 is the place of 0.18, of two powers that meet there with one slope:
// y = (x / x0)^2.77 / 2 below, y = 1 - ((1 - x) / (1 - x0))^1.8 / 2 above; the spline holds its values and slopes.
// Half a percent of each channel reaches the other two first, so that highlights lose their colour as on film.
// Greys lie within 0.02 (0.0085 rms) of the view that Blender 3 calls Filmic.
constexpr const char ocio_config[] = R"(ocio_profile_version: 2.1
name: pluvia
strictparsing: true

environment: {}
search_path: ""

roles:
  default: linear
  scene_linear: linear
  rendering: linear
  data: raw
  color_timing: srgb
  compositing_log: linear

file_rules:
  - !<Rule> {name: Default, colorspace: linear}

displays:
  sRGB:
    - !<View> {name: srgb, colorspace: srgb}
    - !<View> {name: filmic, colorspace: filmic}
    - !<View> {name: aces, colorspace: aces}
    - !<View> {name: raw, colorspace: raw}

colorspaces:
  - !<ColorSpace>
    name: linear
    description: Scene-linear light, Rec.709 primaries, white point D65.
    bitdepth: 32f
    encoding: scene-linear

  - !<ColorSpace>
    name: raw
    description: Values as they are.
    bitdepth: 32f
    isdata: true

  - !<ColorSpace>
    name: srgb
    description: The curve of IEC 61966-2-1.
    bitdepth: 32f
    encoding: sdr-video
    from_scene_reference: !<ExponentWithLinearTransform> {gamma: 2.4, offset: 0.055, direction: inverse}

  - !<ColorSpace>
    name: filmic
    description: 16.5 stops on an sRGB display.
    bitdepth: 32f
    encoding: sdr-video
    from_scene_reference: !<GroupTransform>
      children:
        - !<MatrixTransform>
          matrix: [0.99, 0.005, 0.005, 0,
                   0.005, 0.99, 0.005, 0,
                   0.005, 0.005, 0.99, 0,
                   0, 0, 0, 1]
        - !<AllocationTransform> {allocation: lg2, vars: [-12.473931188, 4.026068812]}
        - !<GradingRGBCurveTransform>
          style: log
          master:
            control_points: [0, 0.0000, 0.1, 0.0034, 0.2, 0.0232, 0.3, 0.0713, 0.4, 0.1581, 0.5, 0.2934,
                             0.6061, 0.5000, 0.7, 0.6938, 0.8, 0.8524, 0.9, 0.9576, 1, 1.0000]
            slopes: [0.0000, 0.0941, 0.3211, 0.6581, 1.0951, 1.6255, 2.2851, 1.8377, 1.3285, 0.7629, 0.0000]

  - !<ColorSpace>
    name: aces
    description: ACES 1.0 SDR output transform on an sRGB display.
    bitdepth: 32f
    encoding: sdr-video
    from_scene_reference: !<GroupTransform>
      children:
        - !<MatrixTransform>
          matrix: [0.412390799, 0.357584339, 0.180480788, 0,
                   0.212639006, 0.715168679, 0.072192315, 0,
                   0.019330819, 0.119194780, 0.950532152, 0,
                   0, 0, 0, 1]
        - !<BuiltinTransform> {style: UTILITY - ACES-AP0_to_CIE-XYZ-D65_BFD, direction: inverse}
        - !<BuiltinTransform> {style: ACES-OUTPUT - ACES2065-1_to_CIE-XYZ-D65 - SDR-VIDEO_1.0}
        - !<BuiltinTransform> {style: DISPLAY - CIE-XYZ-D65_to_sRGB}
)";

}  // namespace pluvia
