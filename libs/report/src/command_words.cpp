#include "command_words.h"

#include <ssphh/core/error.h>

namespace ssphh::report {

std::vector<std::string> split_words(const std::string& text, const std::string& where) {
  std::vector<std::string> words;
  std::string word;
  char quote = 0;
  bool open = false;
  for (const char c : text) {
    if (quote != 0) {
      if (c == quote) {
        quote = 0;
      } else {
        word += c;
      }
    } else if (c == '"' || c == '\'') {
      quote = c, open = true;
    } else if (c == ' ' || c == '\n' || c == '\t') {
      if (open) words.push_back(std::move(word));
      word.clear(), open = false;
    } else {
      word += c, open = true;
    }
  }
  if (quote != 0) throw Error(where, "a quote is not closed");
  if (open) words.push_back(std::move(word));
  return words;
}

std::vector<std::string> names_in(const std::string& word, const std::string& where) {
  std::vector<std::string> names;
  for (std::size_t at = word.find('{'); at != std::string::npos; at = word.find('{', at)) {
    const std::size_t end = word.find('}', at);
    if (end == std::string::npos) throw Error(where, "'{' without '}' in " + word);
    names.push_back(word.substr(at + 1, end - at - 1));
    at = end;
  }
  return names;
}

std::string substitute(const std::string& word, const Parameters& values) {
  std::string result;
  for (std::size_t i = 0; i < word.size();) {
    const std::size_t end = word[i] == '{' ? word.find('}', i) : std::string::npos;
    const std::string name = end == std::string::npos ? "" : word.substr(i + 1, end - i - 1);
    const std::string* value = nullptr;
    for (const auto& [key, text] : values) {
      if (!name.empty() && key == name) value = &text;
    }
    if (value) {
      result += *value, i = end + 1;
    } else {
      result += word[i++];
    }
  }
  return result;
}

std::string join_words(const std::vector<std::string>& words) {
  const std::string plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_=+./:,@%";
  std::string line;
  for (const std::string& word : words) {
    if (!line.empty()) line += ' ';
    if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) {
      line += word;
      continue;
    }
    line += '\'';
    for (const char c : word) line += c == '\'' ? std::string("'\\''") : std::string(1, c);
    line += '\'';
  }
  return line;
}

}  // namespace ssphh::report
