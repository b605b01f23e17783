#pragma once
/// A file changed in one place at a time, and what is new in the text of the scene that it then becomes.

#include <algorithm>
#include <map>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "expected_text.h"
#include "json_text.h"

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

/// With the members of every object in the order of their names, whatever the order in which they were
/// written.
inline json::Value sorted(const json::Value& value) {
  if (value.is_array()) {
    json::Value result = json::Value::array();
    for (const json::Value& element : value.elements()) result.push_back(sorted(element));
    return result;
  }
  if (!value.is_object()) return value;
  std::map<std::string, json::Value> members;
  for (const auto& [name, member] : value.members()) members.emplace(name, sorted(member));
  return members;
}

/// Other values of a member: too small, too large, of another kind.
inline std::vector<json::Value> others(const json::Value& value) {
  if (value.is_boolean()) return {!value.boolean(), 1};
  if (value.is_integer()) return {-1, static_cast<int>(value.number()) + 1, 1000000};
  if (value.is_number()) return {-1.5, 0, 0.25 * value.number(), 2.5, 1e39};
  if (value.is_string()) return {"A:%41", std::string(70, 'm'), 7};
  if (!value.is_array() || value.empty()) return {3};
  json::Array shorter = value.elements(), longer = value.elements();
  shorter.pop_back(), longer.push_back(value.elements().back());
  return {shorter, longer};
}

inline bool is_plain(const json::Value& value) {
  return !value.is_array() && !value.is_object();
}

/// Calls tell(what was changed) with every member of a document changed, one at a time: others(), and left
/// out. Of an array of plain values the first and the last. `value` is what stands at `place` in it.
template <class Tell>
void change_members(json::Value& value, const Tell& tell, const std::string& place = {}) {
  const json::Value whole = value;
  const auto change = [&](const auto& key, const std::string& part) {
    const json::Value before = value[key];
    for (const json::Value& other : others(before)) {
      value[key] = other;
      tell(place + part + " " +
           (!is_plain(before) && other.is_array() ? fmt::format("of {}", other.size()) : print(other)));
    }
    if constexpr (!std::is_integral_v<std::remove_cvref_t<decltype(key)>>) {
      value.erase(key);
      tell(place + part + " left out");
    }
    value = whole;
    change_members(value[key], tell, place + part);
  };
  if (value.is_object())
    for (const auto& [name, unused] : whole.members()) change(name, "/" + name);
  for (std::size_t i = 0; value.is_array() && i < whole.size(); ++i)
    if (!is_plain(whole[i]) || i == 0 || i + 1 == whole.size()) change(i, fmt::format("/{}", i));
}

}  // namespace ssphh::test
