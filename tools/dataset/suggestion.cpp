#include "tools/dataset/suggestion.h"

#include <algorithm>
#include <numeric>

namespace pluvia {
namespace {

size_t changes(const std::string& a, const std::string& b) {
    std::vector<size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), size_t(0));
    for (size_t i = 0; i < a.size(); ++i) {
        size_t diagonal = row[0];
        row[0] = i + 1;
        for (size_t k = 0; k < b.size(); ++k) {
            const size_t replaced = diagonal + (a[i] != b[k]);
            diagonal = row[k + 1];
            row[k + 1] = std::min({replaced, row[k] + 1, row[k + 1] + 1});
        }
    }
    return row.back();
}

}  // namespace

std::string nearest_word(const std::string& word, const std::vector<std::string>& candidates) {
    size_t fewest = std::max<size_t>(2, word.size() / 3) + 1;
    std::string best;
    for (const std::string& candidate : candidates)
        if (const size_t n = changes(word, candidate); n < fewest) fewest = n, best = candidate;
    return best;
}

}  // namespace pluvia
