#include "uri.h"

#include <array>
#include <cstdint>

#include <fmt/format.h>

#include <ssphh/core/error.h>

#include "printable.h"

namespace ssphh::scene_io {
namespace {

constexpr std::array<std::int8_t, 256> base64_values() {
  std::array<std::int8_t, 256> table{};
  for (auto& v : table) v = -1;
  constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t i = 0; i < alphabet.size(); ++i) {
    table[static_cast<unsigned char>(alphabet[i])] = static_cast<std::int8_t>(i);
  }
  return table;
}

std::vector<std::byte> decode_base64(std::string_view text, const std::string& where) {
  static constexpr auto values = base64_values();
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  if (text.size() % 4 == 1) throw Error(where, "the base64 data is cut short");
  std::vector<std::byte> bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  std::uint32_t bits = 0;
  int bit_count = 0;
  for (const char c : text) {
    const int value = values[static_cast<unsigned char>(c)];
    if (value < 0) throw Error(where, "the base64 data holds a character that is none of base64's");
    bits = (bits << 6) | static_cast<std::uint32_t>(value);
    bit_count += 6;
    if (bit_count >= 8) {
      bit_count -= 8;
      bytes.push_back(static_cast<std::byte>((bits >> bit_count) & 0xff));
    }
  }
  return bytes;
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

std::string decode_percent(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '%' && i + 2 < text.size() && hex_digit(text[i + 1]) >= 0 && hex_digit(text[i + 2]) >= 0) {
      out.push_back(static_cast<char>(hex_digit(text[i + 1]) * 16 + hex_digit(text[i + 2])));
      i += 2;
    } else {
      out.push_back(text[i]);
    }
  }
  return out;
}

}  // namespace

std::optional<std::vector<std::byte>> decode_data_uri(std::string_view uri, const std::string& where) {
  if (!uri.starts_with("data:")) return std::nullopt;
  const auto comma = uri.find(',');
  if (comma == uri.npos) throw Error(where, "the data URI has no comma before its data");
  if (uri.substr(0, comma).ends_with(";base64")) return decode_base64(uri.substr(comma + 1), where);
  const std::string text = decode_percent(uri.substr(comma + 1));
  const auto* begin = reinterpret_cast<const std::byte*>(text.data());
  return std::vector<std::byte>(begin, begin + text.size());
}

std::filesystem::path resolve_uri(std::string_view uri, const std::filesystem::path& base_file,
                                  const std::string& where) {
  const std::string shown = printable(uri, 80);
  const auto colon = uri.find(':');
  if (colon != uri.npos && colon < uri.find('/')) {
    throw Error(where, fmt::format("\"{}\" is neither a relative file name nor a data URI", shown));
  }
  const std::filesystem::path relative = decode_percent(uri);
  if (relative.empty() || relative.is_absolute() || relative.native().find('\0') != std::string::npos) {
    throw Error(where, fmt::format("\"{}\" is not a relative file name", shown));
  }
  return base_file.parent_path() / relative;
}

}  // namespace ssphh::scene_io
