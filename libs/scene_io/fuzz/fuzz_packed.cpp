// Arbitrary bytes as the packed data of a file that is fine otherwise: the first says how it is packed, the
// second how much comes out. Mutations of whole files seldom reach the decoders.

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/core/log.h>
#include <ssphh/scene_io/gltf.h>

namespace {

struct Kind {
  const char *mode, *filter;
  int stride;
};
constexpr std::array kinds = {Kind{"ATTRIBUTES", "NONE", 12},
                              Kind{"ATTRIBUTES", "OCTAHEDRAL", 4},
                              Kind{"ATTRIBUTES", "OCTAHEDRAL", 8},
                              Kind{"ATTRIBUTES", "QUATERNION", 8},
                              Kind{"ATTRIBUTES", "EXPONENTIAL", 12},
                              Kind{"TRIANGLES", "NONE", 2},
                              Kind{"TRIANGLES", "NONE", 4},
                              Kind{"INDICES", "NONE", 2},
                              Kind{"INDICES", "NONE", 4}};

// A view of packed elements, and an image that reads all of it.
std::string meshopt_file(const Kind& kind, std::size_t count, std::size_t size) {
  return fmt::format(
      R"({{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":{0}}},{{"byteLength":{1}}}],"bufferViews":[
      {{"buffer":1,"byteLength":{1},"extensions":{{"EXT_meshopt_compression":{{"buffer":0,"byteLength":{0},
      "byteStride":{2},"count":{3},"mode":"{4}","filter":"{5}"}}}}}}],"images":[{{"bufferView":0}}],
      "textures":[{{"source":0}}],"materials":[{{"emissiveTexture":{{"index":0}}}}]}})",
      size, count * static_cast<std::size_t>(kind.stride), kind.stride, count, kind.mode, kind.filter);
}

std::string draco_file(std::size_t count, std::size_t size) {
  return fmt::format(
      R"({{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":{0}}}],"bufferViews":[{{"buffer":0,"byteLength":{0}}}],
      "accessors":[{{"componentType":5126,"type":"VEC3","count":{1}}},{{"componentType":5125,"type":"SCALAR","count":{1}}}],
      "nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1,"extensions":
      {{"KHR_draco_mesh_compression":{{"bufferView":0,"attributes":{{"POSITION":0}}}}}}}}]}}]}})",
      size, count);
}

std::vector<std::byte> container(std::string json, std::span<const std::uint8_t> data) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::array<std::uint32_t, 5> head = {0x46546c67, 2,
                                             static_cast<std::uint32_t>(28 + json.size() + data.size()),
                                             static_cast<std::uint32_t>(json.size()), 0x4e4f534a};
  const std::array<std::uint32_t, 2> chunk = {static_cast<std::uint32_t>(data.size()), 0x004e4942};
  std::vector<std::byte> out;
  const auto append = [&](std::span<const std::byte> part) {
    out.insert(out.end(), part.begin(), part.end());
  };
  append(std::as_bytes(std::span(head)));
  append(std::as_bytes(std::span(json)));
  append(std::as_bytes(std::span(chunk)));
  append(std::as_bytes(data));
  return out;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace ssphh;
  static const LogSink silent = set_log_sink([](LogLevel, const std::string&) {});
  if (size < 2) return 0;
  const std::size_t kind = bytes[0] % (kinds.size() + 4), count = std::size_t{3} * bytes[1];
  std::span<const std::uint8_t> data(bytes + 2, size - 2);
  // What stands before the counts, so that mutations need not find it
  std::vector<std::uint8_t> draco = {'D', 'R', 'A', 'C', 'O', 2, 2, 1, static_cast<std::uint8_t>(kind % 2),
                                     0,   0};
  draco.insert(draco.end(), data.begin(), data.end());
  const auto file = kind < kinds.size() ? container(meshopt_file(kinds[kind], count, data.size()), data)
                                        : container(draco_file(count, draco.size()), draco);
  try {
    scene_io::load_gltf(file, "/nonexistent/fuzz.glb");
  } catch (const Error&) {
  }
  return 0;
}
