#include "message.h"

#include <bit>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include <fmt/format.h>

#include <ssphh/core/error.h>

namespace ssphh::farm {
namespace {

constexpr std::string_view magic = "SSPHHMSG";
constexpr std::size_t header_bytes = 12;
static_assert(std::endian::native == std::endian::little);

bool is_reference(const json::Value& value) {
  return value.is_object() && value.size() == 1 && value.contains("f32");
}

}  // namespace

json::Value exact(float value) {
  char text[32];
  *fmt::format_to_n(text, sizeof(text) - 1, "{:.9g}", value).out = '\0';
  return std::strtod(text, nullptr);
}

json::Value exact(const vec3& v) {
  return json::Value::array({exact(v.x), exact(v.y), exact(v.z)});
}

json::Value MessageWriter::floats(std::span<const float> values) {
  if (type_ == ContentType::binary) {
    const std::size_t first = raw_.size();
    raw_.insert(raw_.end(), values.begin(), values.end());
    return {{"f32", json::Value::array({first, values.size()})}};
  }
  json::Value array = json::Value::array();
  for (const float value : values) array.push_back(exact(value));
  return array;
}

std::string MessageWriter::finish(const json::Value& document) const {
  std::string text = json::print(document);
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
  message.where = where;
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
  message.document = json::parse(text, where, {.bytes = max_json_bytes});
  return message;
}

std::optional<Field> Field::find(const char* name) const {
  const auto member = Cursor::find(name);
  if (!member) return std::nullopt;
  return Field(*member, *raw_);
}

std::size_t Field::float_count() const {
  if (!is_reference(value())) return size();
  const Field range = (*this)["f32"];
  if (range.size() != 2) fail("\"f32\" must be [first, count]");
  const std::uint64_t total = raw_->bytes.size() / sizeof(float);
  return range[1].unsigned_integer(total - range[0].unsigned_integer(total));
}

void Field::floats(std::span<float> out) const {
  if (float_count() != out.size()) fail(fmt::format("must be {} numbers, not {}", out.size(), float_count()));
  if (!is_reference(value())) {
    numbers(out);
    return;
  }
  const std::uint64_t first = (*this)["f32"][0].unsigned_integer();
  if (out.size() > raw_->bytes.size() / sizeof(float) - raw_->read) fail("floats are used twice");
  raw_->read += out.size();
  if (!out.empty()) std::memcpy(out.data(), raw_->bytes.data() + first * sizeof(float), out.size_bytes());
  for (const float number : out)
    if (!std::isfinite(number)) fail("holds a number that is not finite");
}

}  // namespace ssphh::farm
