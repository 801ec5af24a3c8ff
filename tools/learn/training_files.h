// Files of a training: pairs of pictures that it learns from, the log of its losses, and their plot.
#pragma once

#include "tools/learning/training.h"

#include <string>
#include <vector>

namespace pluvia {

/// Three pictures that belong together.
struct TrainingFiles {
    std::string background, mask, rainy;
};
/// Of folders with the same names.
std::vector<TrainingFiles> training_files(const std::string& backgrounds, const std::string& masks,
                                          const std::string& rainy);
/// Of a list in HRI's layout (trainset.json): records with background, rain_layer and rainy_image, relative to its
/// folder. Throws Error (input).
std::vector<TrainingFiles> training_files_of_dataset(const std::string& list);
TrainingPair read_training_pair(const TrainingFiles& files);

/// Lines "step,loss" of a training. A file that has them is continued: lines from first_step on are dropped.
class LossLog {
public:
    LossLog(const std::string& path, int first_step);
    /// Kept in memory until write().
    void add(int step, double loss);
    void write() const;
    /// The losses as a curve, SVG.
    void plot(const std::string& path) const;

private:
    std::string path_;
    std::vector<std::pair<int, double>> losses_;
};

}  // namespace pluvia
