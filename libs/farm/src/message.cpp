#include "message.h"

#include <bit>
#include <charconv>
#include <cstdlib>
#include <cstring>

#include <fmt/format.h>

namespace ssphh::farm {
namespace {

constexpr std::string_view magic = "SSPHHMSG";
constexpr std::size_t header_bytes = 12;
static_assert(std::endian::native == std::endian::little);

bool is_reference(const Json& value) {
  return value.is_object() && value.size() == 1 && value.contains("f32");
}

}  // namespace

Json exact(float value) {
  char text[32];
  *fmt::format_to_n(text, sizeof(text) - 1, "{:.9g}", value).out = '\0';
  return std::strtod(text, nullptr);
}

Json exact(const vec3& v) {
  return Json::array({exact(v.x), exact(v.y), exact(v.z)});
}

Json MessageWriter::floats(std::span<const float> values) {
  if (type_ == ContentType::binary) {
    const std::size_t first = raw_.size();
    raw_.insert(raw_.end(), values.begin(), values.end());
    return {{"f32", Json::array({first, values.size()})}};
  }
  Json array = Json::array();
  for (const float value : values) array.push_back(exact(value));
  return array;
}

std::string MessageWriter::finish(const Json& document) const {
  std::string text = document.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (type_ == ContentType::json) return text;
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const auto size = static_cast<std::uint32_t>(text.size());
  std::string body(header_bytes + text.size() + raw_.size() * sizeof(float), '\0');
  char* out = body.data();
  std::memcpy(out, magic.data(), magic.size());
  std::memcpy(out + magic.size(), &size, sizeof(size));
  std::memcpy(out + header_bytes, text.data(), text.size());
  if (!raw_.empty()) std::memcpy(out + header_bytes + text.size(), raw_.data(), raw_.size() * sizeof(float));
  return body;
}

ContentType content_type(std::string_view body) {
  return body.starts_with(magic) ? ContentType::binary : ContentType::json;
}

Message parse_message(std::string_view body, const std::string& where) {
  std::string_view text = body;
  Message message;
  if (content_type(body) == ContentType::binary) {
    if (body.size() < header_bytes) throw Error(where, "is cut off");
    std::uint32_t size;
    std::memcpy(&size, body.data() + magic.size(), sizeof(size));
    if (size > body.size() - header_bytes || size % 4 != 0 ||
        (body.size() - header_bytes - size) % sizeof(float) != 0)
      throw Error(where, "its sizes do not fit");
    text = body.substr(header_bytes, size);
    message.raw.bytes = std::as_bytes(std::span(body)).subspan(header_bytes + size);
  }
  if (text.size() > max_json_bytes) throw Error(where, "is too large");
  message.document = Json::parse(text, nullptr, false);
  if (!message.document.is_object()) throw Error(where, "is no JSON object");
  return message;
}

std::optional<Field> Field::find(const char* key) const {
  if (!value_.is_object()) fail("must be an object");
  const auto it = value_.find(key);
  if (it == value_.end()) return std::nullopt;
  return Field(*it, where_ + "/" + key, raw_);
}

Field Field::operator[](const char* key) const {
  if (auto field = find(key)) return *field;
  fail(fmt::format("\"{}\" is missing", key));
}

Field Field::at(std::size_t i) const {
  return {value_[i], fmt::format("{}/{}", where_, i), raw_};
}

std::size_t Field::size(std::size_t limit) const {
  if (!value_.is_array()) fail("must be an array");
  if (value_.size() > limit) fail(fmt::format("has more than {} elements", limit));
  return value_.size();
}

std::string Field::text(std::size_t limit) const {
  if (!value_.is_string()) fail("must be a string");
  const auto& text = value_.get_ref<const std::string&>();
  if (text.size() > limit) fail("is too long");
  return text;
}

bool Field::flag() const {
  if (!value_.is_boolean()) fail("must be true or false");
  return value_.get<bool>();
}

std::int64_t Field::integer(std::int64_t low, std::int64_t high) const {
  const bool fits =
      value_.is_number_integer() && !(value_.is_number_unsigned() && value_.get<std::uint64_t>() > INT64_MAX);
  const std::int64_t value = fits ? value_.get<std::int64_t>() : 0;
  if (!fits || value < low || value > high) fail(fmt::format("must be a whole number in {}..{}", low, high));
  return value;
}

std::uint64_t Field::hex64() const {
  const std::string digits = text(16);
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
  if (error != std::errc() || end != digits.data() + digits.size()) fail("must be hexadecimal digits");
  return value;
}

Hash128 Field::hash() const {
  const std::string digits = text(32);
  Hash128 hash;
  const char* at = digits.data();
  if (digits.size() == 32) {
    const auto high = std::from_chars(at, at + 16, hash.high, 16);
    const auto low = std::from_chars(at + 16, at + 32, hash.low, 16);
    if (high.ptr == at + 16 && low.ptr == at + 32) return hash;
  }
  fail("must be 32 hexadecimal digits");
}

double Field::real() const {
  if (!value_.is_number()) fail("must be a number");
  return value_.get<double>();
}

float Field::number() const {
  const auto value = static_cast<float>(real());
  if (!std::isfinite(value)) fail("must be a finite number");
  return value;
}

vec3 Field::vector3() const {
  if (size(3) != 3) fail("must be three numbers");
  return {at(0).number(), at(1).number(), at(2).number()};
}

std::size_t Field::float_count() const {
  if (!is_reference(value_)) return size(std::size_t{1} << 24);
  const Field range = (*this)["f32"];
  if (range.size(2) != 2) fail("\"f32\" must be [first, count]");
  const auto total = static_cast<std::int64_t>(raw_.bytes.size() / sizeof(float));
  const std::int64_t first = range.at(0).integer(0, total);
  return static_cast<std::size_t>(range.at(1).integer(0, total - first));
}

void Field::floats(std::span<float> out) const {
  if (float_count() != out.size()) fail(fmt::format("must be {} numbers, not {}", out.size(), float_count()));
  if (is_reference(value_)) {
    const auto first = static_cast<std::size_t>(value_["f32"][0].get<std::int64_t>());
    if (out.size() > raw_.bytes.size() / sizeof(float) - raw_.read) fail("floats are used twice");
    raw_.read += out.size();
    if (!out.empty()) std::memcpy(out.data(), raw_.bytes.data() + first * sizeof(float), out.size_bytes());
    for (const float value : out)
      if (!std::isfinite(value)) fail("holds a number that is not finite");
    return;
  }
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Json& value = value_[i];
    out[i] = value.is_number() ? static_cast<float>(value.get<double>()) : NAN;
    if (!std::isfinite(out[i])) fail(fmt::format("[{}] must be a finite number", i));
  }
}

}  // namespace ssphh::farm
