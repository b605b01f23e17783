#include <algorithm>

#include <ssphh/core/require.h>
#include <ssphh/farm/farm_render.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/scene/query.h>

#include "farm_progress.h"
#include "result_cache.h"
#include "unit_key.h"

namespace ssphh::farm {
namespace {

std::vector<trace::Tile> tiles_of(const trace::RenderParams& params) {
  std::vector<trace::Tile> tiles;
  for (int y = 0; y < params.height; y += tile_edge) {
    for (int x = 0; x < params.width; x += tile_edge) {
      tiles.push_back({x, y, std::min(tile_edge, params.width - x), std::min(tile_edge, params.height - y)});
    }
  }
  return tiles;
}

/// Puts a tile into the picture, with black for the layers that were not asked for. False when the result
/// does not answer the job.
bool store(trace::RenderState& picture, const TileJob& job, const trace::Tile& tile, std::size_t groups,
           const TileResult& result) {
  if (result.tile != tile || result.state.passes_done != job.params.path.passes) return false;
  trace::RenderParams params = job.params;
  params.tile = tile;
  trace::RenderState part = trace::empty_state(params, groups);
  for (const trace::RenderLayer layer : trace::render_layers()) {
    const std::span<const image::Image> from = trace::images_of(result.state, layer);
    const std::span<image::Image> to = trace::images_of(part, layer);
    const bool wanted = std::ranges::count(job.layers, layer) > 0;
    if (from.size() != to.size() ||
        std::ranges::any_of(from, [&](const image::Image& image) { return image.empty() == wanted; }))
      return false;
    if (wanted) std::ranges::copy(from, to.begin());
  }
  part.paths = result.state.paths, part.rays = result.state.rays;
  trace::paste(picture, part, tile);
  return true;
}

}  // namespace

trace::RenderState render(const FarmOptions& options, const scene::Scene& scene, float time,
                          const trace::RenderParams& params, const std::optional<RenderProbes>& probes,
                          const std::vector<trace::RenderLayer>& layers, FarmReport& report,
                          const Control& control) {
  require(options.renderer == Renderer::path, "render", "a farm draws by this program's paths alone");
  require(!probes || probes->set, "render's probes", "there are none");
  // Describe the render and what goes with it.
  ScenePackage package = pack_scene(scene);
  TileJob job;
  job.scene = {package.id, package.manifest.size(), scene::light_hash(scene), time};
  job.params = params;
  job.layers = layers;
  std::vector<Blob> more;
  if (probes) {
    Blob& blob = more.emplace_back(Blob{{}, probes::probes_to_binary(*probes->set)});
    blob.hash = content_hash(blob.bytes);
    job.lighting = lighting_of(*probes, blob);
  }
  const std::vector<trace::Tile> tiles = tiles_of(params);
  if (!tiles.empty()) job.tiles = {tiles.front()};
  validate(job);
  const std::size_t groups = scene::light_groups(scene).size();
  trace::RenderState picture = trace::empty_state(params, groups);
  FarmProgress progress(control, "render", tiles.size(), "tiles");
  report.units += tiles.size();

  // Take what is known.
  std::vector<trace::Tile> left;
  for (const trace::Tile& tile : tiles) {
    const auto known = find_result(options.results, unit_key(job, tile));
    const auto* result = known ? std::get_if<TileJobResult>(&known->data) : nullptr;
    if (!result || result->tiles.size() != 1 || !store(picture, job, tile, groups, result->tiles[0]))
      left.push_back(tile);
  }
  report.cached += tiles.size() - left.size();
  progress.cached(tiles.size() - left.size());

  if (!left.empty()) {
    const BlobServer server(options.broker, std::move(package), std::move(more));
    UnitGroup units;
    units.count = left.size();
    units.body = [&](std::span<const std::size_t> which) {
      TileJob some = job;
      some.tiles.assign(left.begin() + static_cast<std::ptrdiff_t>(which.front()),
                        left.begin() + static_cast<std::ptrdiff_t>(which.front() + which.size()));
      return encode_job(some, options.content);
    };
    units.done = [&](std::span<const std::size_t> which, JobResult result) {
      auto* done = std::get_if<TileJobResult>(&result.data);
      bool good = done && done->tiles.size() == which.size();
      for (std::size_t i = 0; good && i < which.size(); ++i) {
        good = store(picture, job, left[which[i]], groups, done->tiles[i]);
        if (good) {
          keep_result(options.results, unit_key(job, left[which[i]]),
                      {TileJobResult{{std::move(done->tiles[i])}}, {}});
        }
      }
      if (!good) throw Error("worker " + result.stats.worker, "its result does not answer the job");
    };
    dispatch(
        options, {units}, report,
        [&](std::size_t count, const FarmReport& so_far) { progress.finished(count, so_far); }, control);
  }
  picture.passes_done = params.path.passes;
  return picture;
}

}  // namespace ssphh::farm
