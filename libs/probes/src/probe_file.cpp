#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/file.h>
#include <ssphh/core/math.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/probes/probe_limits.h>
#include <ssphh/probes/tile_folder.h>

#include "probe_finish.h"

namespace ssphh::probes {
namespace {

/// Checks of one set, with the place in the words of a JSON pointer (the same for both formats).
class Validator {
 public:
  Validator(const ProbeSet& set, const std::string& where) : set_(set), where_(where) {}

  void run() const {
    require(set_.degree >= 0 && set_.degree <= sh::max_degree, "/degree", "the degree must be 0..10");
    generator();
    require(set_.light_groups.size() <= limits::light_groups, "/light_groups", "there are more than 256");
    for (std::size_t g = 0; g < set_.light_groups.size(); ++g) {
      const std::string at = fmt::format("/light_groups/{}", g);
      text(set_.light_groups[g].name, at + "/name");
      const vec3 scale = set_.light_groups[g].scale;
      for (int c = 0; c < 3; ++c) number(scale[c], 0, limits::scale, at + "/scale");
    }
    require(set_.probes.size() <= limits::probes, "/probes", "there are more than 65536");
    for (std::size_t i = 0; i < set_.probes.size(); ++i) probe(i);
    if (set_.hierarchy) hierarchy(*set_.hierarchy);
    if (set_.fitted) fitted(*set_.fitted);
    if (set_.surface) surface(*set_.surface);
    if (set_.baseline) baseline(*set_.baseline);
  }

 private:
  void require(bool condition, const std::string& at, const std::string& problem) const {
    if (!condition) throw Error(where_ + " at " + at, problem);
  }
  void number(float value, float low, float high, const std::string& at) const {
    if (value >= low && value <= high) return;  // before any text is made: called for every coefficient
    require(false, at, fmt::format("{} is not in {}..{}", value, low, high));
  }
  void text(const std::string& value, const std::string& at) const {
    require(value.size() <= limits::text, at, "the name is longer than 1024 bytes");
  }
  void numbers(std::span<const vec3> values, const std::string& at) const {
    for (const vec3& v : values) {
      for (int c = 0; c < 3; ++c) number(v[c], -limits::coefficient, limits::coefficient, at);
    }
  }
  void function(const sh::RadianceSh& f, const std::string& at) const {
    require(f.values.size() == coefficient_count(), at,
            fmt::format("has {} RGB coefficients; degree {} has {}", f.values.size(), set_.degree,
                        coefficient_count()));
    numbers(f.values, at);
  }
  std::size_t coefficient_count() const {
    return static_cast<std::size_t>(sh::coefficient_count(set_.degree));
  }

  void generator() const {
    const GeneratorInfo& g = set_.generator;
    const auto count = [&](int value, int low, int high, const char* at) {
      require(value >= low && value <= high, at, fmt::format("{} is not in {}..{}", value, low, high));
    };
    count(g.max_depth, 0, limits::depth, "/generator/max_depth");
    count(g.passes, 1, limits::samples, "/generator/passes");
    count(g.spp, 1, limits::samples, "/generator/spp");
    count(g.viz_max_depth, 0, limits::depth, "/generator/viz_max_depth");
    count(g.viz_passes, 1, limits::samples, "/generator/viz_passes");
    count(g.viz_spp, 1, limits::samples, "/generator/viz_spp");
    count(g.face_size, 1, limits::face_size, "/generator/face_size");
    count(g.directions, 0, limits::rays, "/generator/directions");
    number(g.surfel_size, 0, limits::coordinate, "/generator/surfel_size");
    count(g.link_rays, 0, limits::rays, "/generator/link_rays");
    text(g.scene, "/generator/scene");
    number(g.time, -limits::coordinate, limits::coordinate, "/generator/time");
  }

  void probe(std::size_t i) const {
    const Probe& p = set_.probes[i];
    const std::string at = fmt::format("/probes/{}", i);
    text(p.name, at + "/name");
    for (int c = 0; c < 3; ++c)
      number(p.position[c], -limits::coordinate, limits::coordinate, at + "/position");
    number(p.radius, limits::smallest_radius, limits::coordinate, at + "/radius");
    const std::size_t group_count = set_.light_groups.size();
    require(p.groups.size() == group_count, at + "/groups",
            fmt::format("has {} entries for {} light groups", p.groups.size(), group_count));
    for (std::size_t g = 0; g < group_count; ++g) {
      const std::string group_at = fmt::format("{}/groups/{}", at, g);
      if (!p.groups[g].emitted.empty()) function(p.groups[g].emitted, group_at + "/emitted");
      function(p.groups[g].reflected, group_at + "/reflected");
    }
    int last = -1;
    for (std::size_t e = 0; e < p.edges.size(); ++e) {
      const Edge& edge = p.edges[e];
      const std::string edge_at = fmt::format("{}/edges/{}", at, e);
      require(edge.from > last && edge.from < static_cast<int>(set_.probes.size()) &&
                  edge.from != static_cast<int>(i),
              edge_at + "/from", "must be another probe's index, in ascending order");
      last = edge.from;
      number(edge.transfer, 0, limits::coefficient, edge_at + "/transfer");
      function(edge.h, edge_at + "/h");
      const std::vector<vec3>& matrix = edge.matrix.values;
      if (matrix.empty()) continue;
      require(matrix.size() == coefficient_count() * coefficient_count(), edge_at + "/matrix",
              fmt::format("has {} RGB entries; degree {} has {}", matrix.size(), set_.degree,
                          coefficient_count() * coefficient_count()));
      numbers(matrix, edge_at + "/matrix");
    }
  }

  void hierarchy(const Hierarchy& h) const {
    require(h.neighbors >= -1 && h.neighbors <= static_cast<int>(limits::probes), "/hierarchy/neighbors",
            "must be -1 (all) or a count");
    number(h.threshold, 0, limits::coefficient, "/hierarchy/threshold");
    require(h.neighbor.size() == set_.probes.size(), "/hierarchy", "needs one neighbour part per probe");
    for (std::size_t i = 0; i < h.neighbor.size(); ++i)
      function(h.neighbor[i], fmt::format("/probes/{}/neighbor", i));
  }

  void place(const rays::SurfacePoint& point, const std::string& at) const {
    for (int c = 0; c < 3; ++c)
      number(point.position[c], -limits::coordinate, limits::coordinate, at + "/position");
    const float length = glm::length(point.normal);
    require(std::abs(length - 1) <= 1e-3f, at + "/normal", fmt::format("its length is {}, not 1", length));
  }

  void surface(const SurfaceRecords& s) const {
    require(s.points.size() <= limits::surface_records, "/surface",
            fmt::format("there are more than {}", limits::surface_records));
    require(
        s.groups.size() == set_.light_groups.size(), "/surface",
        fmt::format("has the light of {} groups; the set has {}", s.groups.size(), set_.light_groups.size()));
    for (const std::vector<PackedRecordLight>& group : s.groups)
      require(group.size() == s.points.size(), "/surface", "needs the light of every point");
    require(s.direct.empty() || s.direct.size() == s.groups.size(), "/surface",
            "has direct light of some groups without telling of all");
    for (const std::vector<PackedRecordLight>& group : s.direct)
      require(group.empty() || group.size() == s.points.size(), "/surface",
              "needs the direct light of every point");
    for (std::size_t i = 0; i < s.points.size(); ++i) {
      const std::string at = fmt::format("/surface/{}", i);
      place(s.points[i], at);
      for (const std::vector<PackedRecordLight>& group : s.groups)
        number(group[i].scale, 0, limits::coefficient, at + "/groups");
      for (const std::vector<PackedRecordLight>& group : s.direct)
        if (!group.empty()) number(group[i].scale, 0, limits::coefficient, at + "/direct");
    }
  }

  void baseline(const Baseline& b) const {
    require(b.viz_neighbors >= -1 && b.viz_neighbors <= static_cast<int>(limits::probes),
            "/baseline/neighbors", "must be -1 (all) or a count");
    number(b.viz_threshold, 0, limits::coefficient, "/baseline/threshold");
    require(b.records >= 0 && b.records <= static_cast<int>(limits::surface_records), "/baseline/records",
            "must be a count");
    require(b.most_surfels >= 0 && b.most_surfels <= limits::surfels, "/baseline/surfels", "must be a count");
    require(b.items.size() <= limits::scene_items, "/baseline/items",
            fmt::format("there are more than {}", limits::scene_items));
    for (std::size_t i = 0; i < b.items.size(); ++i)
      text(b.items[i].name, fmt::format("/baseline/items/{}/name", i));
    require(b.trials.empty() || b.trials.size() == set_.probes.size(), "/baseline/trials",
            "needs one entry per probe, or none");
    constexpr auto coefficients = static_cast<std::size_t>(sh::coefficient_count(trial_degree));
    for (std::size_t i = 0; i < b.trials.size(); ++i) {
      const std::string at = fmt::format("/baseline/trials/{}", i);
      for (const std::vector<sh::RadianceSh>& half : b.trials[i].halves) {
        require(half.size() == set_.light_groups.size(), at, "needs one entry per light group");
        for (const sh::RadianceSh& light : half) {
          require(light.values.size() == coefficients, at, "must be of degree 2");
          numbers(light.values, at);
        }
      }
    }
  }

  void fitted(const FittedPoints& f) const {
    require(f.points.size() <= limits::fitted_points, "/fitted",
            fmt::format("there are more than {}", limits::fitted_points));
    require(f.weights.size() == f.points.size(), "/fitted", "needs the weights of every point");
    for (std::size_t i = 0; i < f.points.size(); ++i) {
      const std::string at = fmt::format("/fitted/{}", i);
      place(f.points[i], at);
      const int count = f.weights[i].count;
      require(count >= 0 && count <= max_weights, at + "/weights",
              fmt::format("there are {}, not 0..{}", count, max_weights));
      for (const ProbeWeight& entry : f.weights[i].used()) {
        require(entry.probe >= 0 && static_cast<std::size_t>(entry.probe) < set_.probes.size(),
                at + "/probes", "must be indices of probes");
        number(entry.weight, 0, limits::fitted_weight, at + "/weights");
      }
    }
  }

  const ProbeSet& set_;
  const std::string& where_;
};

}  // namespace

void validate(const ProbeSet& set, const std::string& where) {
  Validator(set, where).run();
}

void finish_reading(ProbeSet& set, const std::string& where) {
  validate(set, where);
  merge_groups(set);
  if (!set.hierarchy) return;
  set.hierarchy->sum = set.hierarchy->neighbor;
  for (std::size_t i = 0; i < set.probes.size(); ++i) set.hierarchy->sum[i] += set.probes[i].self;
}

ProbeFileFormat probe_file_format(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  if (extension == ".json") return ProbeFileFormat::json;
  if (extension == ".sphl") return ProbeFileFormat::binary;
  if (is_tile_folder(path)) return ProbeFileFormat::tiles;
  throw Error(path.string(), "is not the name of a probe file",
              "it must end in .sphl (binary), .sphl.json (JSON) or .tiles (a folder)");
}

ProbeSet read_probe_file(const std::filesystem::path& path) {
  switch (probe_file_format(path)) {
    case ProbeFileFormat::json:
      return probes_from_json(read_text_file(path, limits::json_bytes), path.string());
    case ProbeFileFormat::tiles:
      return TileFolder(path).join();
    case ProbeFileFormat::binary:
      break;
  }
  return probes_from_binary(read_file(path, limits::binary_bytes), path.string());
}

void write_probe_file(const ProbeSet& set, const std::filesystem::path& path, sh::Packing packing) {
  if (probe_file_format(path) == ProbeFileFormat::tiles)
    throw Error(path.string(), "only a bake writes tiles", "choose a name that ends in .sphl");
  if (probe_file_format(path) == ProbeFileFormat::binary)
    return write_file(path, probes_to_binary(set, packing));
  if (packing != sh::Packing::none)
    throw Error(path.string(), "JSON holds no packed light", "choose a name that ends in .sphl");
  write_file(path, probes_to_json(set));
}

}  // namespace ssphh::probes
