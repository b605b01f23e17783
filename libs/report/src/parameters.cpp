#include "parameters.h"

namespace ssphh::report {
namespace {

std::string value_text(const Json& value, const std::string& where) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number()) return value.dump();
  throw Error(where, "must be a number or text");
}

}  // namespace

Parameters read_parameters(const Json& json, const std::string& where) {
  if (!json.is_object()) throw Error(where, "must be an object of names and values");
  Parameters parameters;
  for (const auto& [key, value] : json.items())
    parameters.emplace_back(key, value_text(value, where + "/" + key));
  return parameters;
}

std::vector<Parameters> read_variants(const Json* json, const std::string& where) {
  if (!json) return {{}};
  std::vector<Parameters> variants;
  if (json->is_array()) {
    for (const Json& item : *json) variants.push_back(read_parameters(item, where));
  } else if (json->is_object()) {
    variants.emplace_back();
    for (const auto& [key, values] : json->items()) {
      if (!values.is_array() || values.empty()) throw Error(where + "/" + key, "must be a list of values");
      std::vector<Parameters> longer;
      for (const Parameters& start : variants) {
        for (const Json& value : values) {
          longer.push_back(start);
          longer.back().emplace_back(key, value_text(value, where + "/" + key));
        }
      }
      variants = std::move(longer);
    }
  } else {
    throw Error(where, "must be an object of lists or a list of objects");
  }
  if (variants.empty()) throw Error(where, "is empty");
  return variants;
}

}  // namespace ssphh::report
