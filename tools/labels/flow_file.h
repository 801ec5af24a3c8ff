// Optical flow in the files of Middlebury (.flo) and KITTI (16-bit RGB PNG), written and read.
#pragma once

#include <string>
#include <vector>

namespace pluvia {

/// Pixels to the right and down, rows from the top. Where valid is 0 nothing is known and u and v are 0.
struct Flow {
    int width = 0, height = 0;
    std::vector<float> u, v;
    std::vector<uint8_t> valid;
};

/// Little-endian: the float 202021.25, width, height, then u and v of every pixel. Unknown: 1e10; readers take any
/// value above 1e9 for it. Source: Baker et al. 2011, "A Database and Evaluation Methodology for Optical Flow".
void write_flo(const std::string& path, const Flow& flow);
/// Throws Error (input) for what is no such file.
Flow read_flo(const std::string& path);

/// Red and green: 64 u + 32768 and 64 v + 32768, rounded; blue: 1 where valid. Flow beyond 512 pixels is not valid
/// there. Source: KITTI flow devkit.
void write_kitti_flow(const std::string& path, const Flow& flow);
Flow read_kitti_flow(const std::string& path);

}  // namespace pluvia
