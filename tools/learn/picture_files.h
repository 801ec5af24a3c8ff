// Pictures in folders, and which of them belong together: those of the same name, whatever the extension.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace pluvia {

/// Pictures by their name without extension. path: a folder (its sub-folders are not looked into) or one file.
/// Throws Error (input) when there is none, or two have the same name.
std::map<std::string, std::string> pictures_in(const std::string& path);

/// A clean picture and a mask, and the name that their result has: the clean picture's, or the mask's where one clean
/// picture goes with several.
struct PicturePair {
    std::string name, background, mask;
};
/// A single picture on one side goes with all of the other. Throws Error (input) naming one without partner.
std::vector<PicturePair> pair_pictures(const std::string& backgrounds, const std::string& masks);

/// A rain picture and CRIGNet's label of it: intensity / 50 mm/h - 1, and wind.
struct LabelledPicture {
    std::string name;
    double intensity, wind;
};
/// A list as CRIGNet has it beside its pictures: [{"img": name, "label": [intensity, wind]}, ...].
void write_picture_labels(const std::string& path, const std::vector<LabelledPicture>& pictures);

}  // namespace pluvia
