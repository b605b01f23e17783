#pragma once
/// Reading a JSON object whose keys are all known, with the place in every message.

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <ssphh/core/error.h>

namespace ssphh::report {

using Json = nlohmann::ordered_json;

class Object {
 public:
  /// Throws Error unless `json` is an object with no other keys than `known`.
  Object(const Json& json, std::string where, std::vector<std::string> known);

  /// The value, or null; `must` throws when it is absent.
  const Json* find(const char* key) const;
  const Json& must(const char* key) const;

  std::string text(const char* key, const std::string& otherwise = {}) const;
  double number(const char* key, double otherwise, double low, double high) const;
  int integer(const char* key, int otherwise, int low, int high) const;
  bool flag(const char* key, bool otherwise) const;
  /// A list of strings; empty when absent. A single string counts as a list of one.
  std::vector<std::string> texts(const char* key) const;
  /// The elements of a list; empty when absent.
  std::vector<const Json*> items(const char* key) const;

  std::string at(const std::string& key) const { return where_ + "/" + key; }

 private:
  const Json& json_;
  std::string where_;
};

}  // namespace ssphh::report
