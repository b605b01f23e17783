#include "gltf_draco.h"

#include <algorithm>
#include <cmath>

#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>
#include <fmt/format.h>

#include "gltf_parts.h"
#include "printable.h"

namespace ssphh::scene_io {
namespace {

/// What a mesh may ask for.
struct Expected {
  GltfDocument& document;
  const json::Cursor& place;
  std::optional<std::uint64_t> faces, points;

  // Encoders drop triangles without area and equal vertices: fewer are right, too.
  void require(const std::optional<std::uint64_t>& most, std::uint64_t found, const char* noun) const {
    if (most && found > *most)
      place.fail(fmt::format("the packed mesh has {} {}, its accessors have {}", found, noun, *most));
  }
};

/// Draco's decoder, which takes memory for the counts that it reads: looks at them first.
template <class Decoder>
class Watched : public Decoder {
 public:
  explicit Watched(const Expected& expected) : expected_(expected) {}

 private:
  // The counts stand first: of points and faces, in the order of the method.
  bool DecodeConnectivity() override {
    constexpr bool edgebreaker = std::is_same_v<Decoder, draco::MeshEdgebreakerDecoder>;
    draco::DecoderBuffer ahead = *this->buffer();
    std::uint32_t first = 0, second = 0, symbols = 0, splits = 0;
    std::uint8_t seams = 0;
    if (!draco::DecodeVarint(&first, &ahead) || !draco::DecodeVarint(&second, &ahead)) return false;
    if (edgebreaker && !(ahead.Decode(&seams) && draco::DecodeVarint(&symbols, &ahead) &&
                         draco::DecodeVarint(&splits, &ahead) && splits <= symbols && symbols <= second))
      return false;
    const std::uint64_t faces = edgebreaker ? second : first, points = edgebreaker ? first : second;
    expected_.require(expected_.faces, faces, "triangles");
    expected_.require(expected_.points, points, "points");
    // Corners, their opposites and vertices; the same again for every attribute with seams
    expected_.document.charge(faces * (64 + 32 * std::uint64_t{seams}) + points * 16, expected_.place);
    return Decoder::DecodeConnectivity();
  }

  bool DecodeAllAttributes() override {
    const draco::PointCloud& cloud = *this->point_cloud();
    expected_.require(expected_.points, cloud.num_points(), "points");
    for (int i = 0; i < cloud.num_attributes(); ++i) {
      // Once as integers, once as they come out
      const auto bytes = static_cast<std::uint64_t>(cloud.attribute(i)->num_components()) * 12;
      expected_.document.charge(cloud.num_points() * bytes, expected_.place);
    }
    return Decoder::DecodeAllAttributes();
  }

  const Expected& expected_;
};

template <class Decoder>
bool decode(const Expected& expected, draco::DecoderBuffer& buffer, draco::Mesh& mesh) {
  const draco::DecoderOptions options;
  return Watched<Decoder>(expected).Decode(options, &buffer, &mesh).ok();
}

void decode_mesh(const Expected& expected, std::span<const std::byte> bytes, draco::Mesh& mesh) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  draco::DecoderBuffer ahead = buffer;
  draco::DracoHeader header;
  const char* damaged = "the packed mesh is damaged or cut short";
  if (!draco::PointCloudDecoder::DecodeHeader(&ahead, &header).ok()) expected.place.fail(damaged);
  if (header.encoder_type != draco::TRIANGULAR_MESH) expected.place.fail("holds no Draco mesh");
  if (header.version_major != 2 || header.version_minor != 2) {
    expected.place.fail(
        fmt::format("holds Draco bitstream {}.{}, glTF's is 2.2", header.version_major, header.version_minor),
        std::string(unpack_first));
  }
  const bool done = header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING
                        ? decode<draco::MeshEdgebreakerDecoder>(expected, buffer, mesh)
                        : header.encoder_method == draco::MESH_SEQUENTIAL_ENCODING &&
                              decode<draco::MeshSequentialDecoder>(expected, buffer, mesh);
  if (!done) expected.place.fail(damaged);
}

FloatArray read_values(GltfDocument& document, draco::PointAttribute& attribute, std::size_t points,
                       const json::Cursor& accessor, const json::Cursor& place) {
  const auto components = static_cast<std::size_t>(attribute.num_components());
  FloatArray out{points, static_cast<int>(components), {}};
  document.charge(points * components * sizeof(float), place);
  out.values.resize(points * components);
  attribute.set_normalized(accessor.boolean_or("normalized", false));
  for (std::size_t p = 0; p < points; ++p) {
    const auto value = attribute.mapped_index(draco::PointIndex(static_cast<std::uint32_t>(p)));
    float* to = &out.values[p * components];
    if (value.value() >= attribute.size() ||
        !attribute.ConvertValue(value, static_cast<std::int8_t>(components), to))
      place.fail(fmt::format("the packed mesh has no value for point {}", p));
    for (std::size_t c = 0; c < components; ++c) {
      if (!std::isfinite(to[c])) place.fail(fmt::format("element {} is NaN or infinite", p));
      if (attribute.normalized()) to[c] = std::max(to[c], -1.0f);
    }
  }
  return out;
}

std::optional<std::uint64_t> count_of(const GltfDocument& document, const json::Cursor& object,
                                      const char* key) {
  const auto accessor = document.reference(object, key, "accessors");
  if (!accessor) return std::nullopt;
  return document.item("accessors", *accessor)["count"].unsigned_integer();
}

}  // namespace

std::optional<DracoPrimitive> read_draco(GltfDocument& document, const json::Cursor& primitive) {
  const auto packed = extension(primitive, "KHR_draco_mesh_compression");
  if (!packed) return std::nullopt;
  const auto mode = primitive.find("mode");
  if (mode && mode->unsigned_integer() != 4 && mode->unsigned_integer() != 5)
    mode->fail("Draco packs triangles only");
  const json::Cursor attributes = primitive["attributes"];
  const auto corners = count_of(document, primitive, "indices");
  if (corners && *corners % 3 != 0) primitive["indices"].fail("packed triangles have three corners each");
  const Expected expected{document, *packed, corners ? std::optional(*corners / 3) : std::nullopt,
                          count_of(document, attributes, "POSITION")};
  const int view = (*packed)["bufferView"].index(document.count("bufferViews"), "bufferViews");
  const auto bytes = document.buffer_view(view).bytes;
  document.count_packed(view);
  draco::Mesh mesh;
  decode_mesh(expected, bytes, mesh);

  DracoPrimitive out;
  const std::uint32_t points = mesh.num_points();
  document.charge(std::uint64_t{mesh.num_faces()} * 3 * sizeof(std::uint32_t), *packed);
  for (std::uint32_t f = 0; f < mesh.num_faces(); ++f) {
    for (const auto& corner : mesh.face(draco::FaceIndex(f))) out.indices.push_back(corner.value());
  }
  for (const auto& [name, unused] : (*packed)["attributes"].entries()) {
    const json::Cursor id = (*packed)["attributes"][name.c_str()];
    const int accessor = attributes[name.c_str()].index(document.count("accessors"), "accessors");
    const auto unique =
        static_cast<std::uint32_t>(id.unsigned_integer(std::numeric_limits<std::uint32_t>::max()));
    const int attribute = mesh.GetAttributeIdByUniqueId(unique);
    if (attribute < 0) id.fail(fmt::format("the packed mesh has no attribute {}", unique));
    out.attributes[name] =
        read_values(document, *mesh.attribute(attribute), points, document.item("accessors", accessor), id);
  }
  return out;
}

}  // namespace ssphh::scene_io
