/// References and sizes of a whole glTF file, also of the parts that its scene does not use: from the JSON
/// alone, before anything is decoded.

#include <fmt/format.h>

#include "gltf_meshopt.h"
#include "gltf_parts.h"

namespace ssphh::scene_io {
namespace {

class Checker {
 public:
  explicit Checker(GltfDocument& document) : document_(document) {}

  // Every top-level array is an array of objects, and each of them passes its check.
  void run() const {
    // A buffer without uri that nothing uses is allowed: its data may come from elsewhere
    for (std::size_t i = 0; i < document_.count("buffers"); ++i) {
      const int index = static_cast<int>(i);
      if (document_.item("buffers", index).find("uri") || (i == 0 && document_.is_glb()))
        document_.buffer(index);
    }
    each("bufferViews", [&](const json::Cursor& v) { buffer_view(v); });
    each("accessors", [&](const json::Cursor& v) { accessor(v); });
    each("images", [&](const json::Cursor& v) { reference(v, "bufferView", "bufferViews"); });
    each("textures", [&](const json::Cursor& v) {
      reference(v, "source", "images");
      if (const auto webp = extension(v, "EXT_texture_webp")) reference(*webp, "source", "images");
      reference(v, "sampler", "samplers");
    });
    each("meshes", [&](const json::Cursor& v) { mesh(v); });
    each("skins", [&](const json::Cursor& v) {
      references(v, "joints", "nodes");
      reference(v, "inverseBindMatrices", "accessors");
      reference(v, "skeleton", "nodes");
    });
    each("nodes", [&](const json::Cursor& v) {
      reference(v, "mesh", "meshes");
      reference(v, "camera", "cameras");
      reference(v, "skin", "skins");
      references(v, "children", "nodes");
    });
    each("scenes", [&](const json::Cursor& v) { references(v, "nodes", "nodes"); });
    each("cameras", [&](const json::Cursor& v) { import_camera(v); });
    for (const char* collection : {"samplers", "materials", "animations"}) each(collection, [](auto&) {});
    if (const auto lights = extension(document_.root(), "KHR_lights_punctual")) {
      if (const auto list = lights->find("lights"))
        for (const json::Cursor& light : json::elements(*list)) import_light(light, document_);
    }
    if (const auto profiles = extension(document_.root(), "EXT_lights_ies")) {
      for (const json::Cursor& profile : json::elements((*profiles)["lights"]))
        reference(profile, "bufferView", "bufferViews");
    }
  }

 private:
  template <class Check>
  void each(const char* collection, const Check& check) const {
    for (const json::Cursor& item : document_.items(collection)) {
      if (!item.is_object()) item.fail(fmt::format("must be an object, not {}", item.value().type_name()));
      check(item);
    }
  }

  void reference(const json::Cursor& object, const char* key, const char* collection) const {
    document_.reference(object, key, collection);
  }

  void references(const json::Cursor& object, const char* key, const char* collection) const {
    const auto list = object.find(key);
    if (!list) return;
    for (const json::Cursor& item : json::elements(*list))
      item.index(document_.count(collection), collection);
  }

  static std::uint64_t integer_or_zero(const json::Cursor& object, const char* key) {
    const auto member = object.find(key);
    return member ? member->unsigned_integer() : 0;
  }

  void buffer_view(const json::Cursor& view) const {
    const int index = view["buffer"].index(document_.count("buffers"), "buffers");
    const std::uint64_t size = document_.item("buffers", index)["byteLength"].unsigned_integer();
    const std::uint64_t begin = integer_or_zero(view, "byteOffset"),
                        length = view["byteLength"].unsigned_integer();
    if (begin > size || length > size - begin) {
      view.fail(
          fmt::format("bytes {} to {} are out of range, the buffer has {}", begin, begin + length, size));
    }
    packed_view(document_, view);
  }

  void accessor(const json::Cursor& accessor) const {
    const auto view_index = document_.reference(accessor, "bufferView", "bufferViews");
    const std::uint64_t element = accessor_element_bytes(accessor),
                        count = accessor["count"].unsigned_integer();
    if (!view_index) return;
    const json::Cursor view = document_.item("bufferViews", *view_index);
    const std::uint64_t size = view["byteLength"].unsigned_integer(),
                        offset = integer_or_zero(accessor, "byteOffset");
    const std::uint64_t stride = std::max(integer_or_zero(view, "byteStride"), element);
    if (offset > size ||
        (count > 0 && (size - offset < element || (size - offset - element) / stride < count - 1))) {
      accessor.fail(fmt::format("{} elements from byte {} do not fit {} of {} bytes", count, offset,
                                view.path(), size));
    }
  }

  void mesh(const json::Cursor& mesh) const {
    for (const json::Cursor& primitive : json::elements(mesh["primitives"])) {
      reference(primitive, "indices", "accessors");
      reference(primitive, "material", "materials");
      if (const auto draco = extension(primitive, "KHR_draco_mesh_compression"))
        reference(*draco, "bufferView", "bufferViews");
      attributes(primitive["attributes"]);
      if (const auto targets = primitive.find("targets"))
        for (const json::Cursor& target : json::elements(*targets)) attributes(target);
    }
  }

  // Attributes of one primitive must be equally long.
  void attributes(const json::Cursor& attributes) const {
    std::optional<std::uint64_t> count;
    if (!attributes.is_object()) attributes.fail("must be an object");
    for (const auto& [name, unused] : attributes.value().members()) {
      const json::Cursor member = attributes[name.c_str()];
      const int index = member.index(document_.count("accessors"), "accessors");
      const std::uint64_t elements = document_.item("accessors", index)["count"].unsigned_integer();
      if (count && elements != *count) {
        member.fail(fmt::format("has {} elements, another attribute has {}", elements, *count));
      }
      count = elements;
    }
  }

  GltfDocument& document_;
};

}  // namespace

void check_structure(GltfDocument& document) {
  Checker(document).run();
}

}  // namespace ssphh::scene_io
