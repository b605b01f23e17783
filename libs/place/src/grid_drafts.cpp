#include <cmath>
#include <map>
#include <tuple>

#include "draft.h"
#include "relocate.h"

namespace ssphh::place {
namespace {

constexpr float refine_below = 0.5f;     ///< harmonic mean distance, in sizes of the cell
constexpr float open_air_reach = 2.0f;   ///< spacings without a surface
constexpr float redundant_below = 0.5f;  ///< spacings to another probe that is in sight

/// Places of all levels by their index in the finest lattice.
class Tree {
 public:
  Tree(const PlaceContext& context, const Lattice& lattice) : context_(context), lattice_(lattice) {
    fine_.box = lattice.box;
    fine_.origin = lattice.origin;
    fine_.spacing = lattice.spacing / static_cast<float>(1 << context.params.levels);
  }

  struct Place {
    vec3 position{0};
    Site site;
    bool in_box = false;
  };
  struct Cell {
    glm::ivec3 corner;  ///< index in the finest lattice
    int level;
  };

  int size(int level) const { return 1 << (context_.params.levels - level); }
  float spacing(int level) const { return fine_.spacing * static_cast<float>(size(level)); }

  /// Examines places that are new; returns their keys in the given order.
  std::vector<glm::ivec3> add(const std::vector<glm::ivec3>& keys) {
    std::vector<glm::ivec3> fresh;
    std::vector<vec3> positions;
    for (const glm::ivec3& key : keys) {
      const auto [at, is_new] = places_.try_emplace(order(key));
      if (!is_new) continue;
      Place& place = at->second;
      place.position = lattice_point(fine_, key);
      place.in_box = inside(fine_.box, place.position);
      if (!place.in_box) continue;
      fresh.push_back(key);
      positions.push_back(place.position);
    }
    const std::vector<Site> sites = look_around(context_.source, positions, fan_size, context_.control);
    for (std::size_t i = 0; i < fresh.size(); ++i) places_.at(order(fresh[i])).site = sites[i];
    return fresh;
  }
  const Place& at(const glm::ivec3& key) const { return places_.at(order(key)); }

  std::vector<Cell> coarse_cells() const {
    std::vector<Cell> cells;
    for (int z = -1; z < lattice_.size.z; ++z) {
      for (int y = -1; y < lattice_.size.y; ++y) {
        for (int x = -1; x < lattice_.size.x; ++x) cells.push_back({size(0) * glm::ivec3(x, y, z), 0});
      }
    }
    return cells;
  }

  glm::ivec3 corner(const Cell& cell, int i) const {
    return cell.corner + size(cell.level) * glm::ivec3(i & 1, (i >> 1) & 1, i >> 2);
  }

  bool to_halve(const Cell& cell) const {
    int good = 0;
    bool near = false, solid = true;
    for (int i = 0; i < 8; ++i) {
      const Place& place = at(corner(cell, i));
      if (!place.in_box) continue;
      solid = solid && place.site.nearest > std::sqrt(3.0f) * spacing(cell.level);
      const bool ok = valid(place.site, context_.rules);
      good += ok ? 1 : 0;
      near = near || (ok && place.site.harmonic < refine_below * spacing(cell.level));
    }
    if (good == 0 && solid) return false;  // deep inside a body, or outside of the box
    return near || good < 8;
  }

 private:
  using Order = std::tuple<int, int, int>;
  static Order order(const glm::ivec3& key) { return {key.z, key.y, key.x}; }

  const PlaceContext& context_;
  const Lattice& lattice_;
  Lattice fine_;
  std::map<Order, Place> places_;
};

/// Takes the drafts that are of use beside those taken before.
class Collector {
 public:
  Collector(const PlaceContext& context, PlaceCounts& counts)
      : context_(context), counts_(counts), grid_(context.spacing) {}

  void take(Draft draft) {
    grid_.add(draft.position);
    drafts_.push_back(std::move(draft));
  }
  bool has_in_sight(const vec3& position, float distance) const {
    for (const std::uint32_t i : grid_.near(position, distance)) {
      if (sees(context_.source, position, drafts_[i].position)) return true;
    }
    return false;
  }
  /// Takes a valid place unless another probe stands beside it.
  void offer(const vec3& position, const Site& site, PlaceKind kind, float spacing, float apart) {
    if (site.escaped > 0.5f && site.nearest > open_air_reach * spacing) {
      ++counts_.open_air;
    } else if (has_in_sight(position, apart)) {
      ++counts_.redundant;
    } else {
      take({{}, position, site, kind, spacing, link_distance * spacing, 0});
    }
  }
  std::vector<Draft> finish() { return std::move(drafts_); }

 private:
  const PlaceContext& context_;
  PlaceCounts& counts_;
  geometry::NearGrid grid_;
  std::vector<Draft> drafts_;
};

void count_invalid(const Site& site, const SiteRules& rules, PlaceCounts& counts) {
  ++(inside_body(site, rules) ? counts.inside : counts.too_close);
}

}  // namespace

std::vector<Draft> grid_drafts(const PlaceContext& context, const Lattice& lattice, PlaceCounts& counts) {
  Collector collector(context, counts);
  for (const scene::ProbePlace& place : context.params.manual) {
    collector.take({place.name, place.position, look_around(context.source, place.position),
                    PlaceKind::manual, context.spacing, link_distance * context.spacing, place.radius});
  }

  // The coarse grid: valid places first, so that a relocated one gives way to them.
  Tree tree(context, lattice);
  std::vector<Tree::Cell> cells = tree.coarse_cells();
  std::vector<glm::ivec3> keys;
  for (const Tree::Cell& cell : cells) {
    for (int i = 0; i < 8; ++i) keys.push_back(tree.corner(cell, i));
  }
  const std::vector<glm::ivec3> coarse = tree.add(keys);
  counts.candidates += coarse.size();
  std::vector<glm::ivec3> invalid;
  for (const glm::ivec3& key : coarse) {
    const Tree::Place& place = tree.at(key);
    if (valid(place.site, context.rules)) {
      collector.offer(place.position, place.site, PlaceKind::grid, context.spacing,
                      redundant_below * context.spacing);
    } else {
      invalid.push_back(key);
    }
  }
  for (const glm::ivec3& key : invalid) {
    const Tree::Place& place = tree.at(key);
    const auto moved =
        relocate(context.source, place.position, place.site, context.rules, 0.5f * context.spacing);
    if (!moved || !inside(lattice.box, moved->position)) {
      count_invalid(place.site, context.rules, counts);
    } else if (collector.has_in_sight(moved->position, redundant_below * context.spacing)) {
      ++counts.redundant;
    } else {
      ++counts.relocated;
      collector.offer(moved->position, moved->site, PlaceKind::grid, context.spacing, 0);
    }
  }

  // Halved cells, level by level.
  for (int level = 1; level <= context.params.levels; ++level) {
    std::vector<Tree::Cell> children;
    keys.clear();
    for (const Tree::Cell& cell : cells) {
      if (!tree.to_halve(cell)) continue;
      for (int i = 0; i < 27; ++i) {
        const glm::ivec3 step(i % 3, i / 3 % 3, i / 9);
        keys.push_back(cell.corner + tree.size(level) * step);
        if (glm::all(glm::lessThan(step, glm::ivec3(2)))) {
          children.push_back({cell.corner + tree.size(level) * step, level});
        }
      }
    }
    const std::vector<glm::ivec3> fresh = tree.add(keys);
    counts.candidates += fresh.size();
    for (const glm::ivec3& key : fresh) {
      const Tree::Place& place = tree.at(key);
      const float parent = tree.spacing(level - 1);
      if (!valid(place.site, context.rules)) {
        count_invalid(place.site, context.rules, counts);
      } else if (place.site.harmonic < refine_below * parent) {
        collector.offer(place.position, place.site, PlaceKind::refined, tree.spacing(level),
                        redundant_below * tree.spacing(level));
      } else {
        collector.offer(place.position, place.site, PlaceKind::refined, tree.spacing(level), parent);
      }
    }
    cells = std::move(children);
  }
  return collector.finish();
}

}  // namespace ssphh::place
