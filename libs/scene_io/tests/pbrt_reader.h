#pragma once
/// Reads pbrt-v4's scene files strictly: what is not of the format throws.

#include <cctype>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "export_fixture.h"

namespace ssphh::test {

struct PbrtParameter {
  std::string type;
  std::vector<std::string> strings;
  std::vector<float> numbers;
};

struct PbrtStatement {
  std::string directive;
  std::vector<std::string> names;  ///< quoted, before the parameters
  std::vector<float> numbers;      ///< not in a parameter
  std::map<std::string, PbrtParameter> parameters;

  const PbrtParameter& at(const std::string& name) const {
    const auto found = parameters.find(name);
    if (found == parameters.end()) throw std::runtime_error(directive + " has no " + name);
    return found->second;
  }
  vec3 vector(const std::string& name) const {
    const std::vector<float>& v = at(name).numbers;
    return v.size() == 3 ? vec3(v[0], v[1], v[2]) : throw std::runtime_error(name + " is not three numbers");
  }
};

inline std::vector<std::string> pbrt_tokens(const std::string& text) {
  std::vector<std::string> tokens;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (c == '#') {
      while (i < text.size() && text[i] != '\n') ++i;
    } else if (std::isspace(static_cast<unsigned char>(c))) {
      ++i;
    } else if (c == '[' || c == ']') {
      tokens.emplace_back(1, c), ++i;
    } else if (c == '"') {
      const std::size_t end = text.find_first_of("\"\n\\", i + 1);
      if (end == std::string::npos || text[end] != '"') throw std::runtime_error("a string without an end");
      tokens.push_back(text.substr(i, end - i + 1)), i = end + 1;
    } else {
      const std::size_t begin = i;
      while (i < text.size() && !std::isspace(static_cast<unsigned char>(text[i])) &&
             std::string("#[]\"").find(text[i]) == std::string::npos)
        ++i;
      tokens.push_back(text.substr(begin, i - begin));
    }
  }
  return tokens;
}

inline bool is_pbrt_string(const std::string& token) {
  return token.front() == '"';
}
inline std::string pbrt_unquoted(const std::string& token) {
  return token.substr(1, token.size() - 2);
}

inline std::vector<PbrtStatement> parse_pbrt(const std::string& text) {
  // How many names stand before the parameters.
  static const std::map<std::string, std::size_t> directives = {
      {"Transform", 0},         {"Camera", 1},        {"Film", 1},
      {"PixelFilter", 1},       {"Sampler", 1},       {"Integrator", 1},
      {"WorldBegin", 0},        {"LightSource", 1},   {"Texture", 3},
      {"MakeNamedMaterial", 1}, {"NamedMaterial", 1}, {"Material", 1},
      {"AreaLightSource", 1},   {"Shape", 1},         {"AttributeBegin", 0},
      {"AttributeEnd", 0},      {"Translate", 0}};
  std::vector<PbrtStatement> statements;
  const std::vector<std::string> tokens = pbrt_tokens(text);
  for (std::size_t i = 0; i < tokens.size();) {
    const auto known = directives.find(tokens[i]);
    if (known == directives.end()) throw std::runtime_error("no directive: " + tokens[i]);
    PbrtStatement s;
    s.directive = tokens[i++];
    while (s.names.size() < known->second) s.names.push_back(pbrt_unquoted(tokens.at(i++)));
    while (i < tokens.size() && !directives.contains(tokens[i])) {
      if (!is_pbrt_string(tokens[i])) {
        if (tokens[i] != "[" && tokens[i] != "]") s.numbers.push_back(numbers_of(tokens[i]).at(0));
        ++i;
        continue;
      }
      std::istringstream declaration(pbrt_unquoted(tokens[i++]));
      std::string name;
      PbrtParameter p;
      declaration >> p.type >> name;
      if (tokens.at(i++) != "[") throw std::runtime_error(name + ": no values");
      for (; tokens.at(i) != "]"; ++i) {
        if (is_pbrt_string(tokens[i]))
          p.strings.push_back(pbrt_unquoted(tokens[i]));
        else if (p.type == "bool")
          p.strings.push_back(tokens[i]);
        else
          p.numbers.push_back(numbers_of(tokens[i]).at(0));
      }
      ++i;
      if (!s.parameters.emplace(name, p).second) throw std::runtime_error(name + " twice");
    }
    statements.push_back(std::move(s));
  }
  return statements;
}

}  // namespace ssphh::test
