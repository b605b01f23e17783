#include <algorithm>
#include <array>
#include <optional>

#include <ssphh/core/parallel.h>

#include "draft.h"

namespace ssphh::gi {
namespace {

constexpr std::size_t stations = 11;   ///< along an edge, both ends included
constexpr std::size_t directions = 8;  ///< across it, each with its opposite
constexpr float narrow = 1.5f;         ///< spacings
constexpr float wider_ends = 1.5f;     ///< times the passage's width

struct Passage {
  vec3 position;
  float width;
};

/// The narrowest place of the way from a to b, across it, if both ends are wider.
std::optional<Passage> narrowest(const scene::TransportSource& source, const vec3& a, const vec3& b,
                                 float widest) {
  const Frame frame = Frame::around(glm::normalize(b - a));
  std::array<vec3, directions> across;
  for (std::size_t k = 0; k < directions; ++k) {
    const float angle = pi * static_cast<float>(k) / directions;
    across[k] = std::cos(angle) * frame.x + std::sin(angle) * frame.y;
  }
  std::array<scene::RayQuery, 2 * stations * directions> rays;
  std::array<scene::RayHit, 2 * stations * directions> hits;
  const auto ray = [](std::size_t station, std::size_t k) { return 2 * (station * directions + k); };
  const auto at = [&](std::size_t station) {
    return a + (b - a) * (static_cast<float>(station) / static_cast<float>(stations - 1));
  };
  for (std::size_t s = 0; s < stations; ++s) {
    for (std::size_t k = 0; k < directions; ++k) {
      rays[ray(s, k)] = {at(s), across[k]};
      rays[ray(s, k) + 1] = {at(s), -across[k]};
    }
  }
  source.intersect(0, rays, hits);
  const auto width = [&](std::size_t station, std::size_t k) {
    return hits[ray(station, k)].distance + hits[ray(station, k) + 1].distance;
  };

  std::optional<Passage> best;
  for (std::size_t s = 1; s + 1 < stations; ++s) {
    for (std::size_t k = 0; k < directions; ++k) {
      const float w = width(s, k);
      if (!(w < widest) || (best && w >= best->width)) continue;
      if (std::min(width(0, k), width(stations - 1, k)) < wider_ends * w) continue;
      const float aside = 0.5f * (hits[ray(s, k)].distance - hits[ray(s, k) + 1].distance);
      best = Passage{at(s) + aside * across[k], w};
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
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          const Draft &a = drafts[edges[i].a], &b = drafts[edges[i].b];
          if (a.position == b.position) continue;
          found[i] = narrowest(context.source, a.position, b.position,
                               narrow * 0.5f * (a.spacing + b.spacing));
          if (found[i]) sites[i] = look_around(context.source, found[i]->position);
        }
      },
      context.control);

  // The narrowest first, so that the result does not hang on the order of the edges.
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (found[i] && valid(sites[i], context.rules)) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return found[i]->width < found[j]->width; });
  NearGrid grid(context.spacing);
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

}  // namespace ssphh::gi
