#include <fmt/format.h>

#include <ssphh/core/version.h>

#include "writers.h"

namespace ssphh::probe_export {
namespace {

constexpr std::uint32_t glb_magic = 0x46546c67, json_chunk = 0x4e4f534a, binary_chunk = 0x004e4942;

/// Chunks begin at multiples of four bytes.
void pad(std::vector<std::byte>& chunk, char with) {
  while (chunk.size() % 4 != 0) chunk.push_back(static_cast<std::byte>(with));
}

std::vector<std::byte> glb(const json::Value& document, std::vector<std::byte> binary) {
  std::vector<std::byte> text = bytes_of(json::print(document));
  pad(text, ' '), pad(binary, '\0');
  ByteWriter out;
  const auto size_of = [](std::size_t bytes) {
    require(bytes < std::size_t{1} << 32, "glTF", "a file of more than 4 GB has no place in GLB");
    return static_cast<std::uint32_t>(bytes);
  };
  out.value(glb_magic), out.value(std::uint32_t{2});
  out.value(size_of(12 + 8 + text.size() + 8 + binary.size()));
  out.value(size_of(text.size())), out.value(json_chunk), out.array(std::span<const std::byte>(text));
  out.value(size_of(binary.size())), out.value(binary_chunk), out.array(std::span<const std::byte>(binary));
  return out.take();
}

}  // namespace

/// A node per probe, whose light an extension of the file's own holds (docs/engines/gltf.md).
Exported write_gltf(const ExportSource& source, const std::string&, const Control&) {
  const std::vector<sh::RadianceSh> light = written_light(source);
  json::Value nodes = json::Value::array(), roots = json::Value::array(), probes = json::Value::array();
  ByteWriter radiance;
  for (std::size_t i = 0; i < light.size(); ++i) {
    const probes::Probe& probe = source.set.probes[i];
    nodes.push_back({{"name", probe.name}, {"translation", json_triple(probe.position)}});
    roots.push_back(i);
    probes.push_back({{"node", i}, {"radius", probe.radius}});
    for (const vec3& v : light[i].values) radiance.vector3(v);
  }
  const std::size_t bytes = radiance.bytes().size();
  const json::Value document = {
      {"asset", {{"version", "2.0"}, {"generator", fmt::format("ssphh {}", SSPHH_VERSION)}}},
      {"extensionsUsed", json::Value::array({"SSPHH_light_probes"})},
      {"scene", 0},
      {"scenes", json::Value::array({json::Value{{"nodes", std::move(roots)}}})},
      {"nodes", std::move(nodes)},
      {"buffers", json::Value::array({json::Value{{"byteLength", bytes}}})},
      {"bufferViews", json::Value::array({json::Value{{"buffer", 0}, {"byteLength", bytes}}})},
      {"accessors",
       json::Value::array({json::Value{
           {"bufferView", 0}, {"componentType", 5126}, {"count", bytes / 12}, {"type", "VEC3"}}})},
      {"extensions", json::Value{{"SSPHH_light_probes", json::Value{{"degree", source.set.degree},
                                                                    {"radiance", 0},
                                                                    {"probes", std::move(probes)}}}}}};
  return {{{"", glb(document, radiance.take())}}, light.size(), 0, {}};
}

}  // namespace ssphh::probe_export
