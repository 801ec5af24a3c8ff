// "Did you mean": the known word that is nearest to a misspelt one.
#pragma once

#include <string>
#include <vector>

namespace pluvia {

/// Of the candidates the one that fewest changes of letters lead to (Levenshtein 1966); empty when none is near: more
/// than a third of the word would change.
std::string nearest_word(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace pluvia
