#pragma once

#include <string>
#include <string_view>

namespace ssphh::scene_io {

/// At most `limit` bytes of a text from a file as valid UTF-8 without control characters, fit for names,
/// messages and JSON. A text that is not UTF-8 is read as Latin-1.
std::string printable(std::string_view text, std::size_t limit = 200);

}  // namespace ssphh::scene_io
