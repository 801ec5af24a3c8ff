// Rain on one picture: its files in, the rainy ones and their record out.
#pragma once

#include "renderer/transport/render.h"
#include "tools/augment/augment_items.h"

#include <optional>

namespace pluvia {

/// What all pictures share, checked.
struct AugmentSettings {
    /// Throws Error (usage) naming the option.
    explicit AugmentSettings(const AugmentOptions& options);

    AugmentOptions options;
    RenderSettings render;
    std::optional<double> ev100;             // empty: of the picture
    std::optional<Environment> environment;  // empty: estimated
};

/// A picture as it was taken.
struct PictureInput {
    PictureSource source;
    DepthFilling filling;
    double ev100 = 0;
    std::string exposed_by;  // where that comes from
};
/// Throws Error (input) with the file.
PictureInput read_picture(const AugmentItem& item, const AugmentSettings& settings);

/// Fingerprint of everything that decides over an item's files, but for the program.
std::string settings_hash(const AugmentItem& item, const AugmentOptions& options);

/// Makes the files of an item and then its record in the output; scratch: an empty folder on the same disk. Throws
/// Error: input where the item's files are at fault, stopped_early when progress says so, others when nothing more can
/// be done.
void augment_item(const AugmentItem& item, const AugmentSettings& settings, const std::string& scratch,
                  const std::string& hash, const ProgressCallback& progress);

}  // namespace pluvia
