#include "json_view.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ssphh/core/error.h>

namespace ssphh::scene_io {
namespace {

constexpr int max_depth = 128;
constexpr std::size_t max_bytes = std::size_t{256} << 20;

// Deepest nesting of brackets outside strings; the text need not be valid.
int nesting_depth(std::string_view text) {
  int depth = 0, deepest = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '{' || c == '[') {
      deepest = std::max(deepest, ++depth);
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
  return deepest;
}

}  // namespace

nlohmann::json parse_json(std::string_view text, const std::string& file) {
  if (text.size() > max_bytes) {
    throw Error(file,
                fmt::format("the JSON is too large: {} bytes, the limit is {}", text.size(), max_bytes));
  }
  if (nesting_depth(text) > max_depth) {
    throw Error(file, fmt::format("the JSON is nested deeper than {} levels", max_depth));
  }
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::exception& e) {
    const std::string_view message = e.what();
    const auto end_of_id = message.find("] ");  // "[json.exception.parse_error.101] parse error at …"
    throw Error(file, fmt::format("is not valid JSON: {}",
                                  end_of_id == message.npos ? message : message.substr(end_of_id + 2)));
  }
}

void JsonView::fail(const std::string& problem, const std::string& hint) const {
  throw Error(path_.empty() ? *file_ : fmt::format("{}: {}", *file_, path_), problem, hint);
}

std::optional<JsonView> JsonView::find(const char* key) const {
  if (!value_->is_object()) fail(fmt::format("must be an object, not {}", value_->type_name()));
  const auto member = value_->find(key);
  if (member == value_->end()) return std::nullopt;
  return JsonView(*member, *file_, path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key));
}

JsonView JsonView::at(const char* key) const {
  auto member = find(key);
  if (!member) fail(fmt::format("\"{}\" is missing", key));
  return *std::move(member);
}

void JsonView::only_keys(std::initializer_list<std::string_view> known) const {
  if (!value_->is_object()) fail(fmt::format("must be an object, not {}", value_->type_name()));
  for (const auto& [key, unused] : value_->items()) {
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      fail(fmt::format("unknown member \"{}\"", key), fmt::format("known are: {}", fmt::join(known, ", ")));
    }
  }
}

std::size_t JsonView::size() const {
  if (!value_->is_array()) fail(fmt::format("must be an array, not {}", value_->type_name()));
  return value_->size();
}

JsonView JsonView::operator[](std::size_t i) const {
  SSPHH_CHECK(i < size());
  return {(*value_)[i], *file_, fmt::format("{}[{}]", path_, i)};
}

std::uint64_t JsonView::integer(std::uint64_t limit) const {
  if (!value_->is_number()) fail(fmt::format("must be a number, not {}", value_->type_name()));
  if (value_->is_number_unsigned()) {
    const auto n = value_->get<std::uint64_t>();
    if (n <= limit) return n;
  } else if (value_->is_number_float()) {
    const double d = value_->get<double>();
    if (d >= 0 && d <= static_cast<double>(limit) && d == std::floor(d)) return static_cast<std::uint64_t>(d);
  }
  fail(fmt::format("{} must be an integer from 0 to {}", value_->dump(), limit));
}

int JsonView::index(std::size_t count, const char* noun) const {
  const std::uint64_t i = integer();
  if (i >= count || i > std::uint64_t{std::numeric_limits<int>::max()}) {
    fail(fmt::format("index {} out of range, the file has {} {}", i, count, noun));
  }
  return static_cast<int>(i);
}

double JsonView::precise_number() const {
  if (!value_->is_number()) fail(fmt::format("must be a number, not {}", value_->type_name()));
  const double d = value_->get<double>();
  if (!(std::abs(d) <= double{std::numeric_limits<float>::max()}))
    fail(fmt::format("{} is too large a number", d));
  return d;
}

float JsonView::number() const {
  return static_cast<float>(precise_number());
}

float JsonView::number(float min, float max) const {
  const float v = number();
  if (v < min || v > max) {
    fail(std::isinf(max) ? fmt::format("{} must be at least {}", v, min)
                         : fmt::format("{} must be from {} to {}", v, min, max));
  }
  return v;
}

bool JsonView::boolean() const {
  if (!value_->is_boolean()) fail(fmt::format("must be true or false, not {}", value_->type_name()));
  return value_->get<bool>();
}

const std::string& JsonView::string() const {
  if (!value_->is_string()) fail(fmt::format("must be a string, not {}", value_->type_name()));
  return value_->get_ref<const std::string&>();
}

void JsonView::numbers(float* out, std::size_t count) const {
  if (size() != count) fail(fmt::format("must have {} numbers, not {}", count, size()));
  for (std::size_t i = 0; i < count; ++i) out[i] = (*this)[i].number();
}

vec2 JsonView::vector2() const {
  vec2 v;
  numbers(&v.x, 2);
  return v;
}

vec3 JsonView::vector3() const {
  vec3 v;
  numbers(&v.x, 3);
  return v;
}

vec4 JsonView::vector4() const {
  vec4 v;
  numbers(&v.x, 4);
  return v;
}

std::size_t array_size(const JsonView& object, const char* key) {
  const auto member = object.find(key);
  return member ? member->size() : 0;
}

std::string text_or(const JsonView& object, const char* key, const std::string& fallback) {
  const auto member = object.find(key);
  return member ? member->string() : fallback;
}

float number_or(const JsonView& object, const char* key, float fallback) {
  const auto member = object.find(key);
  return member ? member->number() : fallback;
}

bool boolean_or(const JsonView& object, const char* key, bool fallback) {
  const auto member = object.find(key);
  return member ? member->boolean() : fallback;
}

}  // namespace ssphh::scene_io
