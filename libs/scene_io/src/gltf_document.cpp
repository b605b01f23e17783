#include "gltf_document.h"

#include <algorithm>
#include <array>
#include <cstring>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/core/file.h>

#include "file_bytes.h"
#include "gltf_meshopt.h"
#include "uri.h"

namespace ssphh::scene_io {
namespace {

std::uint32_t read_u32(std::span<const std::byte> data, std::size_t offset) {
  std::uint32_t v;
  std::memcpy(&v, data.data() + offset, 4);
  return v;
}

struct KnownExtension {
  std::string_view name;
  std::string_view hint;  // empty: supported
};

constexpr std::string_view recode =
    "convert its textures to PNG, JPEG or WebP first, for example with gltf-transform";
constexpr std::string_view transcode =
    "export it with PNG, JPEG or WebP textures, or convert each of them with: ktx extract --transcode rgba8 "
    "IN.ktx2 OUT.png";

constexpr std::array known_extensions = {
    KnownExtension{"EXT_mesh_gpu_instancing", {}},
    KnownExtension{"EXT_meshopt_compression", {}},
    KnownExtension{"EXT_texture_webp", {}},
    KnownExtension{"KHR_draco_mesh_compression", {}},
    KnownExtension{"EXT_lights_ies", {}},
    KnownExtension{"KHR_lights_punctual", {}},
    KnownExtension{"KHR_materials_emissive_strength", {}},
    KnownExtension{"KHR_materials_ior", {}},
    KnownExtension{"KHR_materials_specular", {}},
    KnownExtension{"KHR_materials_transmission", {}},
    KnownExtension{"KHR_materials_volume", {}},
    KnownExtension{"KHR_materials_unlit", {}},
    KnownExtension{"KHR_mesh_quantization", {}},
    KnownExtension{"KHR_meshopt_compression", {}},
    KnownExtension{"KHR_texture_transform", {}},
    KnownExtension{"KHR_texture_basisu", transcode},
    KnownExtension{"EXT_texture_avif", recode},
    KnownExtension{"MSFT_texture_dds", recode},
};

bool supported(std::string_view name) {
  return std::ranges::any_of(known_extensions,
                             [&](const KnownExtension& e) { return e.name == name && e.hint.empty(); });
}

// Counts the members of every "extensions" object; json::parse limits the depth.
void count_extensions(const json::Value& value, std::map<std::string, std::uint64_t>& uses) {
  if (value.is_object()) {
    for (const auto& [key, member] : value.members()) {
      if (key == "extras") continue;
      if (key == "extensions" && member.is_object()) {
        for (const auto& [name, unused] : member.members()) ++uses[name];
      }
      count_extensions(member, uses);
    }
  } else if (value.is_array()) {
    for (const json::Value& element : value.elements()) count_extensions(element, uses);
  }
}

}  // namespace

std::string_view advice_on(std::string_view extension) {
  const auto* known =
      std::ranges::find_if(known_extensions, [&](const KnownExtension& e) { return e.name == extension; });
  return known == known_extensions.end() ? std::string_view{} : known->hint;
}

GltfDocument::GltfDocument(std::span<const std::byte> data, std::filesystem::path path)
    : path_(std::move(path)), file_(path_.string()), input_bytes_(data.size()) {
  if (as_text(data).starts_with("glTF")) {
    parse_glb(data);
  } else {
    json_ = json::parse(as_text(data), file_);
  }
  if (!json_.is_object()) root().fail("must be a JSON object");
  check_version_and_extensions();
  std::map<std::string, std::uint64_t> uses;
  count_extensions(json_, uses);
  for (const auto& [name, count] : uses) {
    if (!supported(name)) ignored.add("extension " + name, count);
  }
}

void GltfDocument::parse_glb(std::span<const std::byte> data) {
  if (data.size() < 12) throw Error(file_, "the GLB header is cut short");
  if (const auto version = read_u32(data, 4); version != 2) {
    throw Error(file_, fmt::format("is GLB version {}, only 2 can be read", version));
  }
  const std::uint32_t length = read_u32(data, 8);
  if (length > data.size()) {
    throw Error(file_, fmt::format("is cut short: the GLB header says {} bytes, the file has {}", length,
                                   data.size()));
  }
  data = data.first(length);

  // Read the chunks: JSON first, then at most one BIN; others are to be skipped
  std::size_t offset = 12;
  for (int chunk = 0; offset < data.size(); ++chunk) {
    if (data.size() - offset < 8)
      throw Error(file_, fmt::format("the header of GLB chunk {} is cut short", chunk));
    const std::uint32_t size = read_u32(data, offset), type = read_u32(data, offset + 4);
    offset += 8;
    if (size > data.size() - offset) {
      throw Error(file_,
                  fmt::format("GLB chunk {} says {} bytes, {} are left", chunk, size, data.size() - offset));
    }
    const auto content = data.subspan(offset, size);
    if (chunk == 0) {
      if (type != 0x4e4f534a) throw Error(file_, "the first GLB chunk is not JSON");
      json_ = json::parse(as_text(content), file_);
    } else if (type == 0x004e4942 && !binary_chunk_) {
      binary_chunk_ = content;
    }
    offset += std::min<std::size_t>((std::size_t{size} + 3) & ~std::size_t{3}, data.size() - offset);
  }
  if (json_.is_null()) throw Error(file_, "the GLB file has no JSON chunk");
}

void GltfDocument::check_version_and_extensions() const {
  const json::Cursor asset = root()["asset"];
  const json::Cursor version = asset.find("minVersion").value_or(asset["version"]);
  if (version.text() != "2.0" && !(version.path() == "asset.version" && version.text().starts_with("2."))) {
    version.fail(fmt::format("glTF {} cannot be read, only 2.0", version.text()));
  }
  const auto required = root().find("extensionsRequired");
  for (std::size_t i = 0; required && i < required->size(); ++i) {
    const std::string& name = (*required)[i].text();
    // A material extension only adds to the look: it is ignored and listed like one that is not required.
    if (supported(name) || name.starts_with("KHR_materials_")) continue;
    (*required)[i].fail(fmt::format("the file requires the extension {}, which is not supported", name),
                        std::string(advice_on(name)));
  }
}

json::Cursor GltfDocument::item(const char* collection, int index) const {
  return root()[collection][index];
}

std::vector<json::Cursor> GltfDocument::items(const char* collection) const {
  const auto array = root().find(collection);
  return array ? json::elements(*array) : std::vector<json::Cursor>{};
}

std::optional<int> GltfDocument::reference(const json::Cursor& object, const char* key,
                                           const char* collection) const {
  const auto member = object.find(key);
  if (!member) return std::nullopt;
  return member->index(count(collection), collection);
}

std::span<const std::byte> GltfDocument::buffer(int index) {
  const json::Cursor buffer = item("buffers", index);
  const std::uint64_t length = buffer["byteLength"].unsigned_integer();
  const auto uri = buffer.find("uri");
  std::span<const std::byte> bytes;
  if (!uri) {
    if (index != 0 || !binary_chunk_) buffer.fail("has no uri, and the file has no GLB chunk for it");
    bytes = *binary_chunk_;
  } else {
    Bytes& owned = buffers_[index];
    if (!owned) {
      const std::string where = fmt::format("{}: {}", file_, uri->path());
      if (auto decoded = decode_data_uri(uri->text(), where)) {
        owned = std::make_shared<const std::vector<std::byte>>(*std::move(decoded));
        charge(owned->size(), buffer);
      } else {
        Bytes& file = files_[resolve_uri(uri->text(), path_, where)];
        if (!file) {
          try {
            file = std::make_shared<const std::vector<std::byte>>(
                read_file(resolve_uri(uri->text(), path_, where)));
          } catch (const Error& e) {
            throw Error(where, e.what(), "buffers lie beside the glTF file; copy them along with it");
          }
          input_bytes_ += file->size();
        }
        owned = file;
      }
    }
    bytes = *owned;
  }
  if (bytes.size() < length) {
    buffer.fail(fmt::format("byteLength is {}, but only {} bytes are there", length, bytes.size()));
  }
  return bytes.first(length);
}

GltfDocument::BufferView GltfDocument::buffer_view(int index) {
  const json::Cursor view = item("bufferViews", index);
  const auto stride_member = view.find("byteStride");
  const std::uint64_t stride = stride_member ? stride_member->unsigned_integer(252) : 0;
  if (const auto packed = packed_view(*this, view)) {
    Bytes& bytes = unpacked_[index];
    if (!bytes) {
      const auto data = part_of_buffer(packed->buffer, packed->begin, packed->length, view);
      count_packed(index);
      charge(packed->count * packed->stride, view);
      bytes = std::make_shared<const std::vector<std::byte>>(unpack(*packed, data, view));
    }
    return {*bytes, stride};
  }
  const auto offset = view.find("byteOffset");
  return {
      part_of_buffer(view["buffer"].index(count("buffers"), "buffers"),
                     offset ? offset->unsigned_integer() : 0, view["byteLength"].unsigned_integer(), view),
      stride};
}

std::span<const std::byte> GltfDocument::part_of_buffer(int index, std::uint64_t begin, std::uint64_t length,
                                                        const json::Cursor& place) {
  const auto bytes = buffer(index);
  if (begin > bytes.size() || length > bytes.size() - begin) {
    place.fail(fmt::format("bytes {} to {} are out of range, the buffer has {}", begin, begin + length,
                           bytes.size()));
  }
  return bytes.subspan(begin, length);
}

void GltfDocument::count_packed(int view) {
  if (!packed_views_.insert(view).second) return;
  const json::Cursor place = item("bufferViews", view);
  const auto packed = packed_view(*this, place);
  input_bytes_ += 15 * (packed ? packed->length : place["byteLength"].unsigned_integer());
}

void GltfDocument::charge(std::uint64_t bytes, const json::Cursor& place) {
  const std::uint64_t limit = (std::uint64_t{64} << 20) + 64 * input_bytes_;
  charged_ = bytes > limit ? limit + 1 : charged_ + bytes;
  if (charged_ > limit) {
    place.fail(fmt::format("the file asks for more than {} MiB of decoded data, too much for its size",
                           limit >> 20));
  }
}

}  // namespace ssphh::scene_io
