#include "printable.h"

namespace ssphh::scene_io {
namespace {

// Length of the UTF-8 character at the start of `text`, 0 when it is none (surrogates and overlong forms
// included).
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(0);
  const std::size_t length = first < 0x80   ? 1
                             : first < 0xc2 ? 0
                             : first < 0xe0 ? 2
                             : first < 0xf0 ? 3
                             : first < 0xf5 ? 4
                                            : 0;
  if (length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
  }
  if (length < 3) return length;
  const bool overlong = (first == 0xe0 && byte(1) < 0xa0) || (first == 0xf0 && byte(1) < 0x90);
  const bool beyond = (first == 0xed && byte(1) >= 0xa0) || (first == 0xf4 && byte(1) >= 0x90);
  return overlong || beyond ? 0 : length;
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

}  // namespace

std::string printable(std::string_view text, std::size_t limit) {
  const bool utf8 = is_utf8(text);
  std::string out;
  while (!text.empty() && out.size() < limit) {
    const auto c = static_cast<unsigned char>(text.front());
    const std::size_t length = utf8 ? utf8_length(text) : 1;
    if (c < 0x20 || c == 0x7f) {
      out += '?';
    } else if (c < 0x80 || utf8) {
      out += text.substr(0, length);
    } else {
      out += static_cast<char>(0xc0 | (c >> 6));
      out += static_cast<char>(0x80 | (c & 0x3f));
    }
    text.remove_prefix(length);
  }
  return out;
}

}  // namespace ssphh::scene_io
