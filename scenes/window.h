// Windows: what is behind their panes, and frames with sashes and bars that fill an opening of wall.h.
// The rooms behind upper windows are pictures under the glass: a street's light does not come from their depth.
#pragma once

#include "scenes/palette.h"
#include "scenes/wall.h"

namespace pluvia {

/// Finish of a pane. kind: dark (an unlit room between curtains), curtain, blind, lit_curtain, lit_room, lit_blind,
/// lit_office (cool light), lit_cafe (warm light), lit_pleats (white curtains), lit_paper; the picture covers a whole
/// opening. What starts with lit is a lamp.
int pane_finish(Palette& palette, const std::string& kind);

/// One of the kinds, as many of them lit as `lit` says, 0 to 1.
std::string random_pane(Chance& chance, float lit);

/// How a window is divided.
struct WindowStyle {
    std::string frame = "white_paint";  // finish
    int columns = 3, rows = 2;          // of panes in each sash
    bool sashes = true;                 // two, one above and before the other; else one casement per opening
    float bar = 0.022f;                 // width of the glazing bars, metres
};

/// Fills an opening; z: face of the frame. pane: kind as in pane_finish.
void add_window(Assembly& assembly, Palette& palette, const Opening& opening, float z, const WindowStyle& style,
                const std::string& pane, Chance& chance);

/// The part of a picture of finish `finish` that lies between `part` in an opening `whole`, at z, as one flat pane that
/// leans by a few milliradians as real ones do.
void add_pane(Assembly& assembly, int finish, const Opening& part, const Opening& whole, float z, Chance& chance);

}  // namespace pluvia
