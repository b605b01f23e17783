#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include <ssphh/core/log.h>
#include <ssphh/core/parallel.h>
#include <ssphh/place/place.h>
#include <ssphh/place/sweep.h>

#include "checks.h"

namespace ssphh::study {
namespace {

/// Probes around a place that are asked whether they see it, the nearest first.
constexpr std::size_t most_asked = 64;

/// The nearest probes other than `self`, by distance.
std::vector<std::size_t> nearest_probes(const LintContext& context, const vec3& place, std::size_t self) {
  std::vector<std::pair<float, std::size_t>> order;
  for (std::size_t i = 0; i < context.set.probes.size(); ++i) {
    const vec3& p = context.set.probes[i].position;
    if (i != self && is_finite(p)) order.emplace_back(glm::distance(p, place), i);
  }
  const std::size_t asked = std::min(order.size(), most_asked);
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(asked), order.end());
  std::vector<std::size_t> nearest;
  for (std::size_t k = 0; k < asked; ++k) nearest.push_back(order[k].second);
  return nearest;
}

bool sees_a_probe(const LintContext& context, const vec3& place) {
  const std::vector<std::size_t> asked = nearest_probes(context, place, context.set.probes.size());
  return std::ranges::any_of(asked, [&](std::size_t i) {
    return place::sees(context.source, place, context.set.probes[i].position);
  });
}

/// Places where one would put probes: somebody may be there.
place::Placement free_places(const LintContext& context) {
  place::PlaceParams place;
  place.spacing = context.params.spacing;
  place.interest = context.params.interest;
  for (const probes::Probe& probe : context.set.probes) {
    if (is_finite(probe.position)) place.interest.push_back(probe.position);
  }
  try {
    return place::place_probes(context.source, place, context.control);
  } catch (const Error& e) {
    log_warning("unseen rooms are not looked for: {}", e.what());
    return {};
  }
}

}  // namespace

std::vector<int> find_rooms(const LintContext& context, std::vector<LintProblem>& problems) {
  const std::vector<probes::Probe>& probes = context.set.probes;
  const std::size_t count = probes.size();
  std::vector<std::vector<std::size_t>> seen(count);
  parallel_for(
      count, 4,
      [&](std::size_t i) {
        if (!is_finite(probes[i].position)) return;
        for (const std::size_t j : nearest_probes(context, probes[i].position, i)) {
          if (place::sees(context.source, probes[i].position, probes[j].position)) seen[i].push_back(j);
        }
      },
      context.control);

  // Rooms: what is connected.
  std::vector<int> room(count);
  std::iota(room.begin(), room.end(), 0);
  const auto root = [&](int i) {
    while (room[i] != i) i = room[i];
    return i;
  };
  const place::Sweep now = place::Sweep::at(context.source, context.set.generator.time);
  std::vector<bool> linked(count, false);
  for (std::size_t i = 0; i < count; ++i) {
    for (const std::size_t j : seen[i]) {
      linked[i] = linked[j] = true;
      if (now.separates(probes[i].position, probes[j].position)) continue;
      const int a = root(static_cast<int>(i)), b = root(static_cast<int>(j));
      room[std::max(a, b)] = std::min(a, b);
    }
  }
  for (std::size_t i = 0; i < count; ++i) room[i] = root(static_cast<int>(i));
  for (std::size_t i = 0; count > 1 && i < count; ++i) {
    if (linked[i]) continue;
    problems.push_back({ProbeProblem::isolated, static_cast<int>(i), probes[i].position,
                        "sees no other probe; add one in between, or remove it if nobody comes there"});
  }
  return room;
}

void check_coverage(const LintContext& context, std::vector<LintProblem>& problems) {
  const place::Placement free = free_places(context);
  const std::size_t count = free.probes.size();
  std::vector<std::uint8_t> unseen(count, 0);
  parallel_for(
      count, 4, [&](std::size_t i) { unseen[i] = sees_a_probe(context, free.probes[i].position) ? 0 : 1; },
      context.control);

  // Unseen neighbours are one place; one in a nook is none.
  std::vector<std::size_t> parent(count);
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i];
    return i;
  };
  for (const place::PlacedEdge& edge : free.edges) {
    if (unseen[edge.a] == 0 || unseen[edge.b] == 0) continue;
    const std::size_t a = root(edge.a), b = root(edge.b);
    parent[std::max(a, b)] = std::min(a, b);
  }
  std::vector<std::size_t> size(count, 0), widest(count, count);
  for (std::size_t i = 0; i < count; ++i) {
    if (unseen[i] == 0) continue;
    const std::size_t r = root(i);
    ++size[r];
    if (widest[r] == count || free.probes[i].clearance > free.probes[widest[r]].clearance) widest[r] = i;
  }
  for (std::size_t r = 0; r < count; ++r) {
    if (size[r] < 2) continue;
    problems.push_back({ProbeProblem::unseen_room, -1, free.probes[widest[r]].position,
                        fmt::format("no probe is to be seen from {} places around here; add one", size[r])});
  }
}

}  // namespace ssphh::study
