#pragma once
/// A scene in parts that travel by content: big arrays (textures, meshes, environment) are blobs of their
/// own, and a manifest holds the rest. Who moves a lamp and bakes again sends the manifest alone.

#include <functional>
#include <span>

#include <ssphh/core/hash.h>
#include <ssphh/scene/scene.h>

namespace ssphh::farm {

struct Blob {
  Hash128 hash;  ///< of the bytes
  std::vector<std::byte> bytes;
};

struct ScenePackage {
  Hash128 id;  ///< of the manifest's bytes, and so of everything
  std::vector<std::byte> manifest;
  std::vector<Blob> blobs;  ///< without doubles
};

Hash128 content_hash(std::span<const std::byte> bytes);

/// Every field of the scene, bit by bit (docs/protocol-jobs.md describes the bytes).
ScenePackage pack_scene(const scene::Scene& scene);

/// The blob of that hash, which has `size` bytes.
using FetchBlob = std::function<std::vector<std::byte>(const Hash128& hash, std::uint64_t size)>;

/// The scene that was packed, bit by bit. Throws Error for bytes that are no manifest, blobs of another size,
/// and for what scene::validate refuses; limits are checked before memory is taken.
scene::Scene unpack_scene(std::span<const std::byte> manifest, const FetchBlob& fetch);

/// A scene in a package takes no more than this, manifest and blobs.
inline constexpr std::uint64_t max_package_bytes = std::uint64_t{16} << 30;
inline constexpr std::uint64_t max_manifest_bytes = std::uint64_t{256} << 20;

}  // namespace ssphh::farm
