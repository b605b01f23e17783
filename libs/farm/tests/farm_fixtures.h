#pragma once
/// A scene in its package, fetched from memory.

#include <ssphh/farm/run_job.h>
#include <ssphh/farm/scene_package.h>
#include <ssphh/place/init.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/scene/query.h>

#include "temp_dir.h"

namespace ssphh::farm::test {

struct PackedScene {
  scene::Scene scene;
  ScenePackage package;
  std::vector<Blob> more;  ///< e.g. probes
  mutable std::uint64_t fetched = 0;

  explicit PackedScene(const char* name) : scene(scene::make_builtin(name)), package(pack_scene(scene)) {}

  SceneRef ref() const { return {package.id, package.manifest.size(), scene::light_hash(scene), 0}; }
  std::span<const std::byte> find(const Hash128& hash) const {
    if (hash == package.id) return package.manifest;
    for (const auto* list : {&package.blobs, &more}) {
      for (const Blob& blob : *list)
        if (blob.hash == hash) return blob.bytes;
    }
    throw BlobUnavailable("no blob " + hash.hex());
  }
  FetchChunk fetch() const {
    return [this](const Hash128&, const Hash128& blob, std::uint64_t offset, std::uint64_t length) {
      const auto chunk = find(blob).subspan(offset, length);
      fetched += chunk.size();
      return std::vector<std::byte>(chunk.begin(), chunk.end());
    };
  }
};

inline ProbeJob gen_job(const PackedScene& packed) {
  const probes::ProbeSet set = place::init_from_scene(packed.scene, 5);
  ProbeJob job;
  job.scene = packed.ref();
  job.degree = 5;
  job.face_size = 8;
  job.path = {2, 3, 2, 0x123456789abcdef0};  // all other than the defaults
  job.probes = {1, 3};
  for (const std::uint32_t i : job.probes)
    job.places.push_back({set.probes[i].position, set.probes[i].radius});
  return job;
}

inline ProbeJob viz_job(const PackedScene& packed) {
  ProbeJob job = gen_job(packed);
  job.stage = bake::BakeStage::viz;
  job.places.clear();
  for (const probes::Probe& probe : place::init_from_scene(packed.scene, 5).probes)
    job.places.push_back({probe.position, probe.radius});
  return job;
}

inline TileJob tile_job(const PackedScene& packed) {
  TileJob job;
  job.scene = packed.ref();
  job.params.width = 40, job.params.height = 24;
  job.params.camera = scene::camera_pose(packed.scene, "", 0);
  job.params.path = {3, 2, 1, 5};
  job.params.per_group = true;
  job.tiles = {{0, 0, 16, 8}, {16, 8, 24, 16}};
  job.layers.assign(trace::render_layers().begin(), trace::render_layers().end());
  return job;
}

}  // namespace ssphh::farm::test
