#pragma once
/// The sections of a cooked file.

#include <array>
#include <cstring>
#include <span>
#include <vector>

#include <ssphh/runtime/cooked_file.h>

namespace ssphh::cook {

struct Sections {
  ssphh_cooked_header header{};
  std::array<std::vector<std::byte>, SSPHH_COOKED_SECTIONS> bytes;

  template <class T>
  void append(int section, std::span<const T> values) {
    std::vector<std::byte>& out = bytes[section];
    const std::size_t begin = out.size();
    out.resize(begin + values.size_bytes());
    if (!values.empty()) std::memcpy(out.data() + begin, values.data(), values.size_bytes());
  }
  template <class T>
  void append(int section, const T& value) {
    append(section, std::span<const T>(&value, 1));
  }
};

/// Places the sections, and fills in what the header says of them: geometry, sizes, checksum.
std::vector<std::byte> file_of(Sections& sections);

}  // namespace ssphh::cook
