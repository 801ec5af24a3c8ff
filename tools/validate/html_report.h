// A comparison as one HTML file that needs nothing beside it: numbers, both pictures under a slider, where they differ,
// and histograms.
#pragma once

#include "tools/validate/comparison.h"

namespace pluvia {

class HtmlReport {
public:
    /// Pictures are kept for this many pairs, the first ones; numbers of all.
    explicit HtmlReport(size_t most_pictures = 12) : most_pictures_(most_pictures) {}

    void add(const ComparedPair& pair);
    /// Throws Error (render_failed) when the file cannot be written.
    void write(const std::string& path, const std::string& a, const std::string& b,
               const std::vector<PairResult>& pairs) const;

private:
    size_t most_pictures_;
    std::vector<std::string> sections_;
};

}  // namespace pluvia
