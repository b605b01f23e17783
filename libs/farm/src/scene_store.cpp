#include <fmt/format.h>

#include <ssphh/core/require.h>
#include <ssphh/farm/scene_package.h>
#include <ssphh/farm/scene_store.h>
#include <ssphh/scene/query.h>

namespace ssphh::farm {

SceneStore::SceneStore(DiskCache& cache, std::size_t keep) : cache_(cache), keep_(keep) {
  require(keep >= 1, "scene store", "keeps 1 at least");
}

std::shared_ptr<const PreparedScene> SceneStore::get(const SceneRef& ref, const FetchChunk& fetch,
                                                     const Control& control) {
  const std::lock_guard lock(mutex_);
  for (auto it = entries_.begin(); it != entries_.end(); ++it) {
    if (it->ref != ref) continue;
    entries_.splice(entries_.begin(), entries_, it);
    return entries_.front().scene;
  }
  if (ref.manifest_bytes > max_manifest_bytes) throw Error("scene manifest", "is too large");
  // Room first: two large scenes at once may not fit.
  while (entries_.size() >= keep_) entries_.pop_back();
  const FetchBlob blob = [&](const Hash128& hash, std::uint64_t size) {
    return fetch_blob(cache_, ref.package, hash, size, fetch, control);
  };
  auto prepared = std::make_shared<PreparedScene>();
  prepared->scene = unpack_scene(blob(ref.package, ref.manifest_bytes), blob);
  const Hash128 light = scene::light_hash(prepared->scene);
  if (light != ref.light) {
    throw Error("scene " + ref.package.hex(),
                fmt::format("has the light hash {}, the job says {}", light.hex(), ref.light.hex()));
  }
  prepared->geometry = std::make_shared<const trace::SceneGeometry>(prepared->scene);
  prepared->tracer = std::make_unique<trace::PathTracer>(prepared->geometry, prepared->scene, ref.time);
  entries_.push_front({ref, prepared});
  return prepared;
}

}  // namespace ssphh::farm
