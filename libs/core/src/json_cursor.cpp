#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/core/json_cursor.h>
#include <ssphh/core/nearest_word.h>

namespace ssphh::json {
namespace {

constexpr double largest_float = std::numeric_limits<float>::max();
constexpr std::size_t shown_bytes = 64;  // of a name or value in a message

/// Nine digits of the largest float are a little more than it.
bool fits_float(double d) {
  return std::isfinite(static_cast<float>(d));
}

std::string shown(const std::string& text) {
  return text.size() <= shown_bytes ? text : text.substr(0, shown_bytes) + "…";
}

std::string range_text(double least, double most) {
  return most >= largest_float ? fmt::format("at least {:g}", least)
                               : fmt::format("from {:g} to {:g}", least, most);
}

std::optional<std::uint64_t> from_hexadecimal(std::string_view digits) {
  if (digits.empty() || digits.size() > 16) return std::nullopt;
  std::uint64_t value = 0;
  for (const char c : digits) {
    const auto digit = std::string_view("0123456789abcdef").find(c);
    if (digit == std::string_view::npos) return std::nullopt;
    value = value << 4 | digit;
  }
  return value;
}

}  // namespace

void Cursor::fail(const std::string& problem, const std::string& hint) const {
  throw Error(place(), problem, hint);
}

std::string Cursor::place() const {
  return path_.empty() ? *file_ : fmt::format("{}: {}", *file_, path_);
}

const Members& Cursor::entries() const {
  if (!value_->is_object()) fail(fmt::format("must be an object, not {}", value_->type_name()));
  return value_->members();
}

std::optional<Cursor> Cursor::find(const char* name) const {
  entries();
  const Value* member = value_->find(name);
  if (!member) return std::nullopt;
  return Cursor(*member, *file_, path_.empty() ? std::string(name) : fmt::format("{}.{}", path_, name));
}

Cursor Cursor::operator[](const char* name) const {
  auto member = find(name);
  if (!member) fail(fmt::format("\"{}\" is missing", name));
  return *std::move(member);
}

const Cursor& Cursor::members(std::initializer_list<std::string_view> required,
                              std::initializer_list<std::string_view> optional) const {
  const Members& there = entries();
  for (const std::string_view name : required) {
    if (!value_->contains(name)) fail(fmt::format("\"{}\" is missing", name));
  }
  const auto among = [](std::initializer_list<std::string_view> names, std::string_view name) {
    return std::ranges::find(names, name) != names.end();
  };
  for (const auto& [name, unused] : there) {
    if (among(required, name) || among(optional, name)) continue;
    std::vector<std::string> known(required.begin(), required.end());
    known.insert(known.end(), optional.begin(), optional.end());
    fail(fmt::format("unknown member \"{}\"", shown(name)), nearest_hint(name.substr(0, shown_bytes), known));
  }
  return *this;
}

std::size_t Cursor::size(std::size_t least, std::size_t most) const {
  if (!value_->is_array()) fail(fmt::format("must be an array, not {}", value_->type_name()));
  const std::size_t size = value_->size();
  if (size < least || size > most) {
    fail(least == most  ? fmt::format("must have {} elements, not {}", least, size)
         : size < least ? fmt::format("must have at least {} elements, not {}", least, size)
                        : fmt::format("must have at most {} elements, not {}", most, size));
  }
  return size;
}

Cursor Cursor::operator[](std::size_t i) const {
  size(i + 1);
  return {(*value_)[i], *file_, fmt::format("{}[{}]", path_, i)};
}

std::int64_t Cursor::integer(std::int64_t least, std::int64_t most) const {
  if (!value_->is_number()) fail(fmt::format("must be a number, not {}", value_->type_name()));
  const std::optional<std::int64_t> i = value_->integer();
  if (!i || *i < least || *i > most)
    fail(fmt::format("{} must be an integer from {} to {}", print(*value_), least, most));
  return *i;
}

std::uint64_t Cursor::unsigned_integer(std::uint64_t most) const {
  constexpr std::uint64_t limit = std::numeric_limits<std::int64_t>::max();
  return static_cast<std::uint64_t>(integer(0, static_cast<std::int64_t>(std::min(most, limit))));
}

int Cursor::index(std::size_t count, const char* noun) const {
  const std::uint64_t i = unsigned_integer();
  if (i >= count || i > std::uint64_t{std::numeric_limits<int>::max()})
    fail(fmt::format("index {} out of range, the file has {} {}", i, count, noun));
  return static_cast<int>(i);
}

double Cursor::precise_number() const {
  if (!value_->is_number()) fail(fmt::format("must be a number, not {}", value_->type_name()));
  const double d = value_->number();
  if (!fits_float(d)) fail(fmt::format("{} is too large a number", d));
  return d;
}

double Cursor::precise_number(double least, double most) const {
  const double d = precise_number();
  if (d < least || d > most) fail(fmt::format("{} must be {}", d, range_text(least, most)));
  return d;
}

float Cursor::number() const {
  return static_cast<float>(precise_number());
}

float Cursor::number(double least, double most) const {
  return static_cast<float>(precise_number(least, most));
}

bool Cursor::boolean() const {
  if (!value_->is_boolean()) fail(fmt::format("must be true or false, not {}", value_->type_name()));
  return value_->boolean();
}

const std::string& Cursor::text(std::size_t most) const {
  if (!value_->is_string()) fail(fmt::format("must be a string, not {}", value_->type_name()));
  const std::string& text = value_->string();
  if (text.size() > most) fail(fmt::format("is longer than {} bytes", most));
  return text;
}

void Cursor::expect_version(int version) const {
  if (is_number() && value_->number() == version) return;
  fail(fmt::format("the version is {:.32}; this program reads version {}", print(*value_), version));
}

void Cursor::expect_format(const char* format, int version) const {
  const Cursor name = (*this)["format"];
  if (name.text() != format) name.fail(fmt::format("must be \"{}\"", format));
  (*this)["version"].expect_version(version);
}

std::uint64_t Cursor::hexadecimal() const {
  const auto value = from_hexadecimal(text());
  if (!value) fail("must be 1 to 16 lower-case hexadecimal digits");
  return *value;
}

Hash128 Cursor::hash() const {
  const std::string_view digits = text();
  const auto high = from_hexadecimal(digits.substr(0, 16)),
             low = from_hexadecimal(digits.substr(std::min<std::size_t>(digits.size(), 16)));
  if (digits.size() != 32 || !high || !low) fail("must be 32 lower-case hexadecimal digits");
  return {*high, *low};
}

void Cursor::numbers(std::span<float> out) const {
  size(out.size(), out.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Value& element = (*value_)[i];  // a place is made where it is wanted alone: arrays may be long
    const bool sound = element.is_number() && fits_float(element.number());
    out[i] = sound ? static_cast<float>(element.number()) : (*this)[i].number();
  }
}

vec2 Cursor::vector2() const {
  vec2 v;
  numbers({&v.x, 2});
  return v;
}

vec3 Cursor::vector3() const {
  vec3 v;
  numbers({&v.x, 3});
  return v;
}

vec4 Cursor::vector4() const {
  vec4 v;
  numbers({&v.x, 4});
  return v;
}

std::size_t Cursor::size_of(const char* name) const {
  const auto member = find(name);
  return member ? member->size() : 0;
}

std::string Cursor::text_or(const char* name, const std::string& otherwise) const {
  const auto member = find(name);
  return member ? member->text() : otherwise;
}

float Cursor::number_or(const char* name, float otherwise) const {
  const auto member = find(name);
  return member ? member->number() : otherwise;
}

bool Cursor::boolean_or(const char* name, bool otherwise) const {
  const auto member = find(name);
  return member ? member->boolean() : otherwise;
}

}  // namespace ssphh::json
