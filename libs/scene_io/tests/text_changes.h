#pragma once
/// A file changed in one place at a time, and what is new in the text of the scene that it then becomes.

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "expected_text.h"

namespace ssphh::test {

/// How many characters two lines begin with alike, up to a blank.
inline std::size_t common(const std::string& a, const std::string& b) {
  const auto [end, unused] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  const std::size_t blank = a.rfind(' ', static_cast<std::size_t>(end - a.begin()));
  return end == a.begin() || blank == std::string::npos ? 0 : blank;
}

/// The lines that stand in `text` and not in `before`, at most three, each from where it begins to differ.
inline std::string news(const std::string& text, const std::vector<std::string>& before) {
  std::string out;
  int count = 0;
  for (const std::string& line : lines_of(text)) {
    if (std::find(before.begin(), before.end(), line) != before.end() || ++count > 3) continue;
    std::size_t same = 0;
    for (const std::string& other : before) same = std::max(same, common(line, other));
    const std::string object = line.substr(0, same == 0 ? 0 : line.find(' '));
    out += "  " + object + (same > object.size() ? " …" : "") + line.substr(same, 120) + "\n";
  }
  return out.empty() ? "  nothing new\n" : out;
}

/// Every line left out, and the last of its words left out or another.
inline std::vector<std::pair<std::string, std::string>> changes_of_lines(const std::string& text) {
  std::vector<std::pair<std::string, std::string>> result;
  const std::vector<std::string> lines = lines_of(text);
  const auto with = [&](std::size_t i, const std::string& line) {
    std::string out;
    for (std::size_t k = 0; k < lines.size(); ++k) out += k == i ? line : lines[k] + "\n";
    return out;
  };
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].starts_with('#')) continue;
    result.emplace_back(lines[i] + " | left out", with(i, ""));
    const std::size_t blank = lines[i].rfind(' ');
    if (blank == std::string::npos) continue;
    for (const std::string& word :
         {std::string(), std::string(" -7"), std::string(" 1e39"), " " + std::string(70, 'x')})
      result.emplace_back(lines[i] + " |" + word, with(i, lines[i].substr(0, blank) + word + "\n"));
  }
  return result;
}

/// Other values of a member: too small, too large, of another kind.
inline std::vector<nlohmann::json> others(const nlohmann::json& value) {
  if (value.is_boolean()) return {!value.get<bool>(), 1};
  if (value.is_number_integer()) return {-1, value.get<int>() + 1, 1000000};
  if (value.is_number()) return {-1.5, 0, 0.25 * value.get<double>(), 2.5, 1e39};
  if (value.is_string()) return {"A:%41", std::string(70, 'm'), 7};
  if (!value.is_array() || value.empty()) return {3};
  nlohmann::json shorter = value, longer = value;
  shorter.erase(shorter.size() - 1), longer.push_back(value.back());
  return {shorter, longer};
}

/// Calls tell(what was changed) with every member of `document` changed, one at a time: others(), and left
/// out. Of an array of plain values the first and the last.
template <class Tell>
void change_members(nlohmann::json& document, const Tell& tell,
                    const nlohmann::json::json_pointer& place = nlohmann::json::json_pointer()) {
  const nlohmann::json value = document[place];
  if (!place.empty()) {
    for (const nlohmann::json& other : others(value)) {
      document[place] = other;
      tell(place.to_string() + " " +
           (value.is_structured() && other.is_array() ? fmt::format("of {}", other.size()) : other.dump()));
    }
    nlohmann::json& parent = document[place.parent_pointer()];
    if (parent.is_object()) {
      parent.erase(place.back());
      tell(place.to_string() + " left out");
    }
    document[place] = value;
  }
  if (value.is_object())
    for (const auto& [key, unused] : value.items()) change_members(document, tell, place / key);
  if (value.is_array())
    for (std::size_t i = 0; i < value.size(); ++i)
      if (value[i].is_structured() || i == 0 || i + 1 == value.size())
        change_members(document, tell, place / i);
}

}  // namespace ssphh::test
