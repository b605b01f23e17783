#include <algorithm>

#include <ssphh/bake/viz.h>

#include "project_cube_map.h"

namespace ssphh::bake {
namespace {

/// T_{j→i} of all j, summed per chunk of the source's work and reduced in chunk order: the same bits for any
/// number of threads.
class MatrixAccumulator {
 public:
  MatrixAccumulator(std::size_t emitter_count, int degree) : emitter_count_(emitter_count), degree_(degree) {}

  rays::RadianceSource::GhostSink sink() {
    const auto k = static_cast<std::size_t>(sh::coefficient_count(degree_));
    constexpr std::size_t memory_limit = std::size_t{4} << 30;
    if (rays::RadianceSource::ghost_chunk_count * emitter_count_ * k * k * sizeof(vec3) > memory_limit) {
      throw Error("VIZ", "the transfer matrices of that many probes do not fit into 4 GiB",
                  "use a lower degree or fewer probes");
    }
    chunks_.resize(rays::RadianceSource::ghost_chunk_count);
    return [this](int chunk, const rays::GhostPath& path) {
      require(chunk >= 0 && static_cast<std::size_t>(chunk) < chunks_.size() && path.emitter >= 0 &&
                  static_cast<std::size_t>(path.emitter) < emitter_count_,
              "radiance source", "a path is of a sphere or chunk that there is not");
      // Only one thread at a time works on a chunk, so it may make its matrices when the first path comes.
      std::vector<sh::TransferMatrix>& matrices = chunks_[chunk];
      if (matrices.empty()) matrices.resize(emitter_count_);
      sh::TransferMatrix& matrix = matrices[path.emitter];
      if (matrix.values.empty()) matrix = sh::TransferMatrix(degree_, degree_);
      sh::add_path(matrix, path.throughput, path.direction, path.emission);
    };
  }

  sh::TransferMatrix reduce(std::size_t emitter) const {
    sh::TransferMatrix sum(degree_, degree_);
    for (const auto& chunk : chunks_) {
      if (!chunk.empty() && !chunk[emitter].values.empty()) sum += chunk[emitter];
    }
    return sum;
  }

 private:
  std::size_t emitter_count_;
  int degree_;
  std::vector<std::vector<sh::TransferMatrix>> chunks_;
};

}  // namespace

std::vector<probes::Edge> viz(const rays::RadianceSource& source, const probes::ProbeSet& set, std::size_t i,
                              const rays::CubeRequest& request, const VizParams& params,
                              const Control& control) {
  require(i < set.probes.size(), "VIZ", "there is no probe of that index");
  sh::require_degree(set.degree, "VIZ");
  // Light every other probe's sphere.
  std::vector<rays::GhostSphere> ghosts;
  std::vector<int> from;
  for (std::size_t j = 0; j < set.probes.size(); ++j) {
    if (j == i) continue;
    ghosts.push_back({set.probes[j].position, set.probes[j].radius});
    from.push_back(static_cast<int>(j));
  }
  if (ghosts.empty()) return {};

  // Trace once from probe i; each sphere has its own cube map.
  rays::CubeRequest at_probe = request;
  at_probe.position = set.probes[i].position;
  at_probe.paths = params.paths;
  MatrixAccumulator matrices(ghosts.size(), set.degree);
  const std::vector<image::CubeMap> cubes =
      source.ghost_radiance(at_probe, ghosts, params.matrix ? matrices.sink() : nullptr, control);
  require(cubes.size() == ghosts.size(), "radiance source",
          "it answers with not one cube map for each sphere");

  // Project, and keep the edges that carry light.
  const sh::CubeProjector projector(set.degree, request.face_size);
  std::vector<probes::Edge> edges;
  for (std::size_t g = 0; g < ghosts.size(); ++g) {
    probes::Edge edge;
    edge.from = from[g];
    edge.h = project_cube_map(projector, cubes[g]);
    edge.h *= vec3(probes::emitter_radiance(params.source, ghosts[g].radius));
    const float transfer = probes::transfer_coefficient(edge.h);
    if (!std::isfinite(transfer))
      throw Error("VIZ of probe \"" + set.probes[i].name + "\"", "the traced light is not finite");
    if (transfer <= params.threshold) continue;
    edge.transfer = transfer;
    if (params.matrix) edge.matrix = matrices.reduce(g);
    edges.push_back(std::move(edge));
  }
  // Keep the strongest, by neighbour.
  if (params.neighbors >= 0 && edges.size() > static_cast<std::size_t>(params.neighbors)) {
    std::ranges::stable_sort(
        edges, [](const probes::Edge& a, const probes::Edge& b) { return a.transfer > b.transfer; });
    edges.resize(static_cast<std::size_t>(params.neighbors));
    std::ranges::sort(edges, {}, &probes::Edge::from);
  }
  return edges;
}

}  // namespace ssphh::bake
