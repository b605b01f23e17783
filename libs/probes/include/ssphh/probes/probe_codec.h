#pragma once
/// What GEN and VIZ find at a probe, in and out, once for every format: which parts there are, in which
/// order, how many numbers each has, which may be missing, and what is refused. A format brings the alphabet:
///
///   Out: index(name, int), amount(name, float), vectors(name, span of vec3, Missing)
///   In:  members(needed, further), size(most, floats_each), operator[](i), index(name, count), amount(name),
///        vectors(name, count, Missing), fail(name, problem)
///
/// which are bytes in binary probe files and in checkpoints, JSON in probe files, and JSON with floats behind
/// it in results of the farm. `vectors` and `size` look at what is there before they take memory.

#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <ssphh/core/json_cursor.h>
#include <ssphh/probes/probe_limits.h>
#include <ssphh/probes/probe_set.h>

namespace ssphh::probes {

/// How a format may say that a part has no numbers.
enum class Missing {
  never,   ///< it has some
  empty,   ///< the part is there and empty
  absent,  ///< the part is not there
};

template <class Out>
void write_light(Out&& out, const GroupLight& light) {
  out.vectors("emitted", light.emitted.values, Missing::empty);
  out.vectors("reflected", light.reflected.values, Missing::never);
}

template <class In>
GroupLight read_light(const In& in, int degree) {
  const auto k = static_cast<std::size_t>(sh::coefficient_count(degree));
  in.members({"emitted", "reflected"}, {});
  GroupLight light;
  light.emitted.values = in.vectors("emitted", k, Missing::empty);
  light.reflected.values = in.vectors("reflected", k, Missing::never);
  return light;
}

template <class Out>
void write_edge(Out&& out, const Edge& edge) {
  out.index("from", edge.from);
  out.amount("transfer", edge.transfer);
  out.vectors("h", edge.h.values, Missing::never);
  out.vectors("matrix", edge.matrix.values, Missing::absent);
}

/// Edges to probe `to` of a set of `probes`; Error unless they come from others in ascending order.
template <class In>
std::vector<Edge> read_edges(const In& in, int degree, std::size_t to, std::size_t probes) {
  const auto k = static_cast<std::size_t>(sh::coefficient_count(degree));
  std::vector<Edge> edges(in.size(probes == 0 ? 0 : probes - 1, 2 + 3 * k));
  int last = -1;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto at = in[e];
    at.members({"from", "transfer", "h"}, {"matrix"});
    Edge& edge = edges[e];
    edge.from = at.index("from", probes);
    if (edge.from <= last || static_cast<std::size_t>(edge.from) == to)
      at.fail("from", "must be another probe's index, in ascending order");
    last = edge.from;
    edge.transfer = at.amount("transfer");
    edge.h.values = at.vectors("h", k, Missing::never);
    edge.matrix.values = at.vectors("matrix", k * k, Missing::absent);
    if (!edge.matrix.values.empty()) edge.matrix.arriving_degree = edge.matrix.emitted_degree = degree;
  }
  return edges;
}

/// The alphabet of JSON documents, to read. `At` is a json::Cursor that tells how many floats an array has,
/// float_count(), and reads them, vectors(span).
template <class At>
class JsonParts {
 public:
  explicit JsonParts(At at) : at_(std::move(at)) {}

  void members(std::initializer_list<std::string_view> needed,
               std::initializer_list<std::string_view> further) const {
    at_.members(needed, further);
  }
  std::size_t size(std::size_t most, std::size_t) const { return at_.size(0, most); }
  JsonParts operator[](std::size_t i) const { return JsonParts(at_[i]); }
  int index(const char* name, std::size_t count) const {
    return static_cast<int>(at_[name].integer(0, static_cast<std::int64_t>(count) - 1));
  }
  float amount(const char* name) const { return at_[name].number(0, limits::coefficient); }
  std::vector<vec3> vectors(const char* name, std::size_t count, Missing missing) const {
    if (missing == Missing::absent && !at_.has(name)) return {};
    const At part = at_[name];
    const std::size_t floats = part.float_count();
    if (missing == Missing::empty && floats == 0) return {};
    if (floats != 3 * count) part.fail(fmt::format("must be {} numbers, not {}", 3 * count, floats));
    std::vector<vec3> values(count);
    part.vectors(values);
    return values;
  }
  [[noreturn]] void fail(const char* name, const std::string& problem) const { at_[name].fail(problem); }

 private:
  At at_;
};

}  // namespace ssphh::probes
