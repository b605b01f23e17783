#include <algorithm>
#include <array>
#include <optional>

#include <ssphh/core/parallel.h>

#include "draft.h"

namespace ssphh::place {
namespace {

constexpr std::size_t stations = 11;    ///< along an edge, both ends included
constexpr std::size_t directions = 13;  ///< axes and diagonals, each with its opposite
constexpr float across = 0.8f;          ///< cosine with the edge above which a direction leads along it
constexpr float narrow = 1.5f;          ///< spacings
constexpr float wider_ends = 1.5f;      ///< times the passage's width
constexpr float centred = 0.85f;        ///< nearest surface, in half widths: less is a corner, not a passage

struct Passage {
  vec3 position;
  float width;
};

const std::array<vec3, directions>& widths() {
  static const std::array<vec3, directions> table = [] {
    std::array<vec3, directions> d;
    std::size_t n = 0;
    for (int i = 14; i < 27; ++i) d[n++] = glm::normalize(vec3(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1));
    return d;
  }();
  return table;
}

/// The narrowest place of the way from a to b, not along it, if both ends are wider in that direction.
std::optional<Passage> narrowest(const rays::TransportSource& source, const vec3& a, const vec3& b,
                                 float widest) {
  const vec3 along = glm::normalize(b - a);
  std::array<rays::RayQuery, 2 * stations * directions> rays;
  std::array<rays::RayHit, 2 * stations * directions> hits;
  const auto ray = [](std::size_t station, std::size_t k) { return 2 * (station * directions + k); };
  const auto at = [&](std::size_t station) {
    return a + (b - a) * (static_cast<float>(station) / static_cast<float>(stations - 1));
  };
  for (std::size_t s = 0; s < stations; ++s) {
    for (std::size_t k = 0; k < directions; ++k) {
      rays[ray(s, k)] = {at(s), widths()[k]};
      rays[ray(s, k) + 1] = {at(s), -widths()[k]};
    }
  }
  source.intersect(0, rays, hits);
  const auto width = [&](std::size_t station, std::size_t k) {
    return hits[ray(station, k)].distance + hits[ray(station, k) + 1].distance;
  };

  std::optional<Passage> best;
  for (std::size_t s = 1; s + 1 < stations; ++s) {
    for (std::size_t k = 0; k < directions; ++k) {
      if (std::abs(glm::dot(widths()[k], along)) > across) continue;
      const float w = width(s, k);
      if (!(w < widest) || (best && w >= best->width)) continue;
      if (std::min(width(0, k), width(stations - 1, k)) < wider_ends * w) continue;
      const float aside = 0.5f * (hits[ray(s, k)].distance - hits[ray(s, k) + 1].distance);
      best = Passage{at(s) + aside * widths()[k], w};
    }
  }
  return best;
}

}  // namespace

void add_passages(const PlaceContext& context, std::vector<Draft>& drafts,
                  const std::vector<PlacedEdge>& edges, PlaceCounts& counts) {
  std::vector<std::optional<Passage>> found(edges.size());
  std::vector<Site> sites(edges.size());
  parallel_for(
      edges.size(), 16,
      [&](std::size_t i) {
        const Draft &a = drafts[edges[i].a], &b = drafts[edges[i].b];
        if (a.position == b.position) return;
        found[i] = narrowest(context.source, a.position, b.position, narrow * 0.5f * (a.spacing + b.spacing));
        if (found[i]) sites[i] = look_around(context.source, found[i]->position);
      },
      context.control);

  // The narrowest first, so that the result does not hang on the order of the edges.
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (found[i] && valid(sites[i], context.rules) && sites[i].nearest > centred * 0.5f * found[i]->width) {
      order.push_back(i);
    }
  }
  std::ranges::stable_sort(order,
                           [&](std::size_t i, std::size_t j) { return found[i]->width < found[j]->width; });
  geometry::NearGrid grid(context.spacing);
  for (const Draft& draft : drafts) grid.add(draft.position);
  for (const std::size_t i : order) {
    const Passage& passage = *found[i];
    ++counts.candidates;
    const float apart = std::min(0.5f * passage.width, 0.5f * context.spacing);
    bool taken = false;
    for (const std::uint32_t j : grid.near(passage.position, apart)) {
      taken = taken || sees(context.source, passage.position, drafts[j].position);
    }
    if (taken) {
      ++counts.redundant;
      continue;
    }
    const float spacing = 0.5f * (drafts[edges[i].a].spacing + drafts[edges[i].b].spacing);
    grid.add(passage.position);
    drafts.push_back({{}, passage.position, sites[i], PlaceKind::passage, spacing, passage.width, 0});
  }
}

}  // namespace ssphh::place
