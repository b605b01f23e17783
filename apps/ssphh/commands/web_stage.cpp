#include "commands/web_stage.h"

#include <bit>

#include <fmt/format.h>

#include <ssphh/core/hash.h>
#include <ssphh/report/packed_image.h>

namespace ssphh::app {
namespace {

/// What is rounded packs better.
image::Image rounded_light(image::Image picture) {
  for (float& x : picture.pixels)
    x = std::bit_cast<float>((std::bit_cast<std::uint32_t>(x) + 0x4000u) & 0xffff8000u);
  return picture;
}

}  // namespace

FolderFile hashed_file(const std::string& stem, const std::string& ending, std::vector<std::byte> data) {
  const std::string digits = Hasher().bytes(data).finish().hex().substr(0, 8);
  return {fmt::format("{}-{}.{}", stem, digits, ending), std::move(data)};
}

std::vector<std::byte> packed_light(const image::Image& atlas) {
  const report::PackedImage p = report::pack_half(rounded_light(atlas));
  const auto bytes = std::as_bytes(std::span(p.bytes));
  return {bytes.begin(), bytes.end()};
}

}  // namespace ssphh::app
