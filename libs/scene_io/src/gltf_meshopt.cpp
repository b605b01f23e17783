#include "gltf_meshopt.h"

#include <array>
#include <limits>

#include <fmt/format.h>
#include <meshoptimizer.h>

#include "gltf_names.h"
#include "gltf_parts.h"

namespace ssphh::scene_io {
namespace {

using Mode = PackedView::Mode;
using Filter = PackedView::Filter;

constexpr auto modes = std::to_array<EnumName<Mode>>(
    {{Mode::attributes, "ATTRIBUTES"}, {Mode::triangles, "TRIANGLES"}, {Mode::indices, "INDICES"}});
constexpr auto filters = std::to_array<EnumName<Filter>>({{Filter::none, "NONE"},
                                                          {Filter::octahedral, "OCTAHEDRAL"},
                                                          {Filter::quaternion, "QUATERNION"},
                                                          {Filter::exponential, "EXPONENTIAL"}});

bool fits(Mode mode, std::uint64_t stride) {
  if (mode == Mode::attributes) return stride >= 4 && stride <= 256 && stride % 4 == 0;
  return stride == 2 || stride == 4;
}

bool fits(Filter filter, std::uint64_t stride) {
  if (filter == Filter::octahedral) return stride == 4 || stride == 8;
  return filter != Filter::quaternion || stride == 8;
}

std::optional<json::Cursor> find_extension(const json::Cursor& view) {
  auto packed = extension(view, "EXT_meshopt_compression");
  return packed ? packed : extension(view, "KHR_meshopt_compression");
}

}  // namespace

std::optional<PackedView> packed_view(const GltfDocument& document, const json::Cursor& view) {
  const auto packed = find_extension(view);
  if (!packed) return std::nullopt;
  PackedView out;
  out.buffer = (*packed)["buffer"].index(document.count("buffers"), "buffers");
  const std::uint64_t size = document.item("buffers", out.buffer)["byteLength"].unsigned_integer();
  const auto offset = packed->find("byteOffset");
  out.begin = offset ? offset->unsigned_integer() : 0;
  out.length = (*packed)["byteLength"].unsigned_integer();
  if (out.begin > size || out.length > size - out.begin) {
    packed->fail(fmt::format("bytes {} to {} are out of range, the buffer has {}", out.begin,
                             out.begin + out.length, size));
  }
  out.count = (*packed)["count"].unsigned_integer(std::numeric_limits<std::uint32_t>::max());
  out.stride = (*packed)["byteStride"].unsigned_integer();
  out.mode = read_word(modes, (*packed)["mode"]);
  if (const auto filter = packed->find("filter")) out.filter = read_word(filters, *filter);

  if (!fits(out.mode, out.stride)) {
    (*packed)["byteStride"].fail(
        fmt::format("{} cannot be, in mode {}", out.stride, (*packed)["mode"].text()));
  }
  if (out.mode == Mode::triangles && out.count % 3 != 0) (*packed)["count"].fail("is no multiple of 3");
  if (out.filter != Filter::none && (out.mode != Mode::attributes || !fits(out.filter, out.stride))) {
    (*packed)["filter"].fail("does not suit the mode and the byteStride");
  }
  const std::uint64_t length = view["byteLength"].unsigned_integer();
  if (out.count * out.stride != length) {
    packed->fail(fmt::format("{} elements of {} bytes are unpacked, the view has {} bytes", out.count,
                             out.stride, length));
  }
  return out;
}

std::vector<std::byte> unpack(const PackedView& packed, std::span<const std::byte> data,
                              const json::Cursor& view) {
  std::vector<std::byte> out(packed.count * packed.stride);
  if (out.empty()) return out;
  const auto* bytes = reinterpret_cast<const unsigned char*>(data.data());
  using Decode = int(void*, std::size_t, std::size_t, const unsigned char*, std::size_t);
  constexpr std::array<Decode*, 3> decoders = {meshopt_decodeVertexBuffer, meshopt_decodeIndexBuffer,
                                               meshopt_decodeIndexSequence};
  Decode* decode = decoders[static_cast<std::size_t>(packed.mode)];
  if (const int wrong = decode(out.data(), packed.count, packed.stride, bytes, data.size())) {
    // −1 is the first byte, which tells kind and version; KHR files may hold version 1 of the vertex codec
    const bool version = wrong == -1 && !data.empty();
    find_extension(view)->fail(version ? "is packed in a way that meshoptimizer 0.18 does not read"
                                       : "the packed data is damaged or cut short",
                               version ? std::string(unpack_first) : std::string());
  }
  if (packed.filter == Filter::octahedral) meshopt_decodeFilterOct(out.data(), packed.count, packed.stride);
  if (packed.filter == Filter::quaternion) meshopt_decodeFilterQuat(out.data(), packed.count, packed.stride);
  if (packed.filter == Filter::exponential) meshopt_decodeFilterExp(out.data(), packed.count, packed.stride);
  return out;
}

}  // namespace ssphh::scene_io
