#include <array>
#include <set>

#include <ssphh/core/bytes.h>
#include <ssphh/farm/scene_package.h>
#include <ssphh/scene/query.h>

#include "scene_fields.h"

namespace ssphh::farm {
namespace {

constexpr std::array<char, 8> manifest_magic = {'S', 'S', 'P', 'H', 'H', 'S', 'C', '1'};
/// Arrays of more bytes are blobs.
constexpr std::size_t inline_bytes = 1024;
constexpr std::size_t max_text = 1 << 16, max_items = 1 << 24;

/// Arrays of these are copied as memory.
template <class T>
constexpr bool is_plain = std::is_arithmetic_v<T> || std::is_same_v<T, vec2> || std::is_same_v<T, vec3> ||
                          std::is_same_v<T, vec4> || std::is_same_v<T, uvec3>;

class Writer {
 public:
  explicit Writer(ScenePackage& package) : package_(package) {
    out_.array(std::span<const char>(manifest_magic));
  }
  std::vector<std::byte> take() { return out_.take(); }

  void operator()(const std::string& text) { out_.text(text); }
  void operator()(bool flag) { out_.value(static_cast<std::uint8_t>(flag)); }
  void operator()(int value) { out_.value(static_cast<std::int32_t>(value)); }
  void operator()(const quat& q) { (*this)(q.x), (*this)(q.y), (*this)(q.z), (*this)(q.w); }
  void operator()(const mat4& m) { out_.array(std::span<const mat4>(&m, 1)); }
  template <class E>
  void choice(E value, E) {
    out_.value(static_cast<std::uint8_t>(value));
  }
  template <class T>
  void operator()(const std::optional<T>& value) {
    (*this)(value.has_value());
    if (value) (*this)(*value);
  }
  template <class T>
  void operator()(const std::shared_ptr<const T>& value) {
    (*this)(value != nullptr);
    if (value) (*this)(*value);
  }
  template <class T>
  void operator()(const std::vector<T>& items) {
    if constexpr (is_plain<T>) {
      array(std::as_bytes(std::span(items)));
    } else {
      out_.value(static_cast<std::uint32_t>(items.size()));
      for (const T& item : items) (*this)(item);
    }
  }
  template <class T>
  void operator()(const T& value) {
    if constexpr (is_plain<T>) {
      out_.array(std::span<const T>(&value, 1));
    } else {
      fields(*this, value, &value);
    }
  }

 private:
  void array(std::span<const std::byte> bytes) {
    out_.value(static_cast<std::uint64_t>(bytes.size()));
    if (bytes.size() <= inline_bytes) return out_.array(bytes);
    const Hash128 hash = content_hash(bytes);
    out_.value(hash.high), out_.value(hash.low);
    if (known_.insert({hash.high, hash.low}).second)
      package_.blobs.push_back({hash, {bytes.begin(), bytes.end()}});
  }

  ByteWriter out_;
  ScenePackage& package_;
  std::set<std::pair<std::uint64_t, std::uint64_t>> known_;
};

class Reader {
 public:
  Reader(std::span<const std::byte> manifest, const FetchBlob& fetch)
      : in_(manifest, "scene manifest"), fetch_(fetch) {
    std::array<char, 8> begin;
    in_.raw("magic", std::span<char>(begin));
    if (begin != manifest_magic) in_.fail("magic", "is not that of a scene manifest");
  }
  void end() { in_.expect_end(); }

  void operator()(std::string& text) { text = in_.text("text", max_text); }
  void operator()(bool& flag) { flag = in_.value_in<std::uint8_t>("flag", 0, 1) != 0; }
  void operator()(int& value) { value = in_.value<std::int32_t>("number"); }
  void operator()(quat& q) { (*this)(q.x), (*this)(q.y), (*this)(q.z), (*this)(q.w); }
  void operator()(mat4& m) { in_.raw("matrix", std::span<mat4>(&m, 1)); }
  template <class E>
  void choice(E& value, E last) {
    value = static_cast<E>(in_.value_in<std::uint8_t>("choice", 0, static_cast<std::uint8_t>(last)));
  }
  template <class T>
  void operator()(std::optional<T>& value) {
    bool there = false;
    (*this)(there);
    if (there) (*this)(value.emplace());
  }
  template <class T>
  void operator()(std::shared_ptr<const T>& value) {
    std::optional<T> read;
    (*this)(read);
    if (read) value = std::make_shared<const T>(std::move(*read));
  }
  template <class T>
  void operator()(std::vector<T>& items) {
    if constexpr (is_plain<T>) {
      array(items);
    } else {
      // Every item takes more than an eighth of its size in memory.
      items.resize(in_.count("count", max_items, sizeof(T) / 8));
      for (T& item : items) (*this)(item);
    }
  }
  template <class T>
  void operator()(T& value) {
    if constexpr (is_plain<T>) {
      in_.raw("number", std::span<T>(&value, 1));
    } else {
      fields(*this, value, &value);
    }
  }

 private:
  template <class T>
  void array(std::vector<T>& items) {
    const auto size = in_.value<std::uint64_t>("array size");
    if (size % sizeof(T) != 0) in_.fail("array", "is no whole number of elements");
    if (size <= inline_bytes) {
      const auto bytes = in_.view("array", size);
      items.resize(size / sizeof(T));
      if (size > 0) std::memcpy(items.data(), bytes.data(), size);
      return;
    }
    if (!fetch_) in_.fail("array", "nothing fetches its blob");
    if (size > max_package_bytes - total_) in_.fail("array", "makes the scene larger than a package may be");
    total_ += size;
    Hash128 hash;
    hash.high = in_.value<std::uint64_t>("blob"), hash.low = in_.value<std::uint64_t>("blob");
    const std::vector<std::byte> bytes = fetch_(hash, size);
    if (bytes.size() != size) in_.fail("blob", hash.hex() + " has another size");
    items.resize(size / sizeof(T));
    std::memcpy(items.data(), bytes.data(), size);
  }

  ByteReader in_;
  const FetchBlob& fetch_;
  std::uint64_t total_ = 0;
};

/// What scene::validate takes for granted.
void check_images(const scene::Scene& scene) {
  const auto fits = [](std::int64_t width, std::int64_t height, std::int64_t channels, std::size_t elements) {
    constexpr std::int64_t limit = 1 << 20;
    return width >= 0 && height >= 0 && width <= limit && height <= limit && channels >= 1 && channels <= 4 &&
           static_cast<std::uint64_t>(width * height * channels) == elements;
  };
  for (const scene::Texture& t : scene.textures) {
    if (!fits(t.width, t.height, 4, t.rgba.size()))
      throw Error("scene manifest: texture \"" + t.name + "\"", "its size does not fit its texels");
  }
  if (!scene.environment) return;
  const image::Image& e = scene.environment->equirect;
  if (!fits(e.width, e.height, e.channels, e.pixels.size()))
    throw Error("scene manifest: environment", "its size does not fit its pixels");
}

}  // namespace

Hash128 content_hash(std::span<const std::byte> bytes) {
  return Hasher().bytes(bytes).finish();
}

ScenePackage pack_scene(const scene::Scene& scene) {
  ScenePackage package;
  Writer writer(package);
  writer(scene);
  package.manifest = writer.take();
  if (package.manifest.size() > max_manifest_bytes)
    throw Error("scene package", "the manifest is larger than 256 MiB", "the scene has too many objects");
  package.id = content_hash(package.manifest);
  return package;
}

scene::Scene unpack_scene(std::span<const std::byte> manifest, const FetchBlob& fetch) {
  Reader reader(manifest, fetch);
  scene::Scene scene;
  reader(scene);
  reader.end();
  check_images(scene);
  scene::validate(scene);
  return scene;
}

}  // namespace ssphh::farm
