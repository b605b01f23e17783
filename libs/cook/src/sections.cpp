#include "sections.h"

#include <cstddef>

#include <ssphh/core/hash.h>

namespace ssphh::cook {
namespace {

/// Of what stays when light is swapped.
std::uint64_t geometry_hash(const Sections& sections) {
  const auto* header = reinterpret_cast<const std::byte*>(&sections.header);
  constexpr std::size_t first = offsetof(ssphh_cooked_header, probe_count),
                        end = offsetof(ssphh_cooked_header, sections);
  Hasher hasher;
  hasher.bytes({header + first, end - first});
  for (std::size_t i = SSPHH_COOKED_PROBES; i <= SSPHH_COOKED_POINTS; ++i) hasher.bytes(sections.bytes[i]);
  return hasher.finish().low;
}

}  // namespace

std::vector<std::byte> file_of(Sections& sections) {
  ssphh_cooked_header& h = sections.header;
  std::memcpy(h.magic, SSPHH_COOKED_MAGIC, sizeof h.magic);
  h.version = SSPHH_COOKED_VERSION;
  h.header_size = sizeof h;
  h.geometry = geometry_hash(sections);
  std::vector<std::byte> file(sizeof h);
  const auto align = [&] {
    constexpr std::size_t a = SSPHH_COOKED_ALIGNMENT;
    file.resize((file.size() + a - 1) / a * a);
  };
  for (std::size_t i = 0; i < sections.bytes.size(); ++i) {
    align();
    h.sections[i] = {file.size(), sections.bytes[i].size()};
    file.insert(file.end(), sections.bytes[i].begin(), sections.bytes[i].end());
  }
  align();
  h.file_size = file.size();
  std::memcpy(file.data(), &h, sizeof h);
  h.checksum = ssphh_cooked_checksum(file.data(), file.size());
  std::memcpy(file.data(), &h, sizeof h);
  return file;
}

}  // namespace ssphh::cook
