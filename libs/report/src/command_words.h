#pragma once
/// Command lines as words.

#include <string>
#include <vector>

#include <ssphh/report/plan.h>

namespace ssphh::report {

/// Splits at spaces; "…" and '…' keep them. Throws Error naming `where` for an open quote.
std::vector<std::string> split_words(const std::string& text, const std::string& where);

/// The names between braces of a word, in order. Throws Error naming `where` for an open brace.
std::vector<std::string> names_in(const std::string& word, const std::string& where);

/// Every {name} replaced by its value, the last one where there are several; unknown names stay.
std::string substitute(const std::string& word, const Parameters& values);

/// As a shell would need them.
std::string join_words(const std::vector<std::string>& words);

}  // namespace ssphh::report
