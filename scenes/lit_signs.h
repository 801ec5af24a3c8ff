// Signs that shine: boxes with a printed front, and letters of neon tube. By day they are what is printed on them.
// Frames: y up, front towards +z; what is fixed to a wall has it at z = 0.
#pragma once

#include "scenes/palette.h"

#include <string>
#include <vector>

namespace pluvia {

/// What is printed on a sign.
struct SignPrint {
    std::string name;  // of its finish; equal names share one picture
    std::vector<std::vector<std::string>> columns =
        {};                             // characters (see characters.h) from top to bottom, columns from right to left
    std::vector<std::string> row = {};  // or one line of characters from left to right
    std::string latin = {};             // small line of Latin capitals below
    Rgb sheet = Rgb(1), writing = Rgb(0.02f), border = {0.8f, 0.05f, 0.03f};
    bool framed = true, spot = false;  // spot: a disk in the border's colour behind the first character
    float aspect = 0.3f;               // width by height of the picture
    float luminance = 120;             // cd/m2 of white
};
int sign_finish(Palette& palette, const SignPrint& print);

/// Box of 2 x half_width by height (from y = 0 up) and 2 x half_depth, printed on both faces, standing out from a wall
/// at the left (x = 0) by `gap`; it hangs on two arms.
Assembly projecting_sign(Palette& palette, const SignPrint& print, float width, float height);

/// Flat box on a wall, centred at x = 0 from y = 0 up.
Assembly wall_sign(Palette& palette, const SignPrint& print, float width, float height);

/// On the ground, on castors, printed on both faces.
Assembly castor_sign(Palette& palette, const SignPrint& print, float width, float height);

/// One or more characters of neon tube before a dark board, from top to bottom, `size` high each.
Assembly neon_sign(Palette& palette, const std::vector<std::string>& characters, float size, const std::string& hue);

/// List of the tenants of a house: rows of small lit plates in several colours.
Assembly tenant_list(Palette& palette, uint64_t seed, int rows);

}  // namespace pluvia
