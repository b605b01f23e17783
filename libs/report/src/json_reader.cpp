#include "json_reader.h"

#include <fmt/format.h>

#include <ssphh/core/nearest_word.h>
#include <ssphh/report/plan.h>

namespace ssphh::report {

Object::Object(const Json& json, std::string where, std::vector<std::string> known)
    : json_(json), where_(std::move(where)) {
  if (!json.is_object()) throw Error(where_, "must be an object");
  for (const auto& [key, value] : json.items()) {
    if (std::find(known.begin(), known.end(), key) == known.end())
      throw Error(where_, fmt::format("unknown key \"{}\"", key), nearest_hint(key, known));
  }
}

const Json* Object::find(const char* key) const {
  const auto it = json_.find(key);
  return it == json_.end() ? nullptr : &*it;
}

const Json& Object::must(const char* key) const {
  const Json* value = find(key);
  if (!value) throw Error(where_, fmt::format("\"{}\" is missing", key));
  return *value;
}

std::string Object::text(const char* key, const std::string& otherwise) const {
  const Json* value = find(key);
  if (!value) return otherwise;
  if (!value->is_string()) throw Error(at(key), "must be text");
  return value->get<std::string>();
}

double Object::number(const char* key, double otherwise, double low, double high) const {
  const Json* value = find(key);
  if (!value) return otherwise;
  if (!value->is_number()) throw Error(at(key), "must be a number");
  const double x = value->get<double>();
  if (!(x >= low && x <= high)) throw Error(at(key), fmt::format("{} is not in {}..{}", x, low, high));
  return x;
}

int Object::integer(const char* key, int otherwise, int low, int high) const {
  const Json* value = find(key);
  if (value && !value->is_number_integer()) throw Error(at(key), "must be a whole number");
  return static_cast<int>(number(key, otherwise, low, high));
}

bool Object::flag(const char* key, bool otherwise) const {
  const Json* value = find(key);
  if (!value) return otherwise;
  if (!value->is_boolean()) throw Error(at(key), "must be true or false");
  return value->get<bool>();
}

std::vector<const Json*> Object::items(const char* key) const {
  std::vector<const Json*> result;
  const Json* value = find(key);
  if (!value) return result;
  if (!value->is_array()) throw Error(at(key), "must be a list");
  for (const Json& item : *value) result.push_back(&item);
  return result;
}

std::vector<std::string> Object::texts(const char* key) const {
  const Json* value = find(key);
  if (value && value->is_string()) return {value->get<std::string>()};
  std::vector<std::string> result;
  for (const Json* item : items(key)) {
    if (!item->is_string()) throw Error(at(key), "must be a list of texts");
    result.push_back(item->get<std::string>());
  }
  return result;
}

}  // namespace ssphh::report
