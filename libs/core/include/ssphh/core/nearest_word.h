#pragma once
/// What somebody who mistyped a name may have meant.

#include <string>
#include <vector>

namespace ssphh {

/// The candidate with the fewest edits (Levenshtein) from `name`, the first of equals; empty when all are
/// farther than half of the name's length.
std::string nearest_word(const std::string& name, const std::vector<std::string>& candidates);

/// Hint of an Error: "did you mean ...?" or, where nothing is near, "known: ...".
std::string nearest_hint(const std::string& name, const std::vector<std::string>& candidates);

}  // namespace ssphh
