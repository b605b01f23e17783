#include "probe_bytes.h"

#include "probe_limits.h"

namespace ssphh::gi {

void write_sh(ByteWriter& out, const sh::RadianceSh& function) {
  out.value(static_cast<std::uint8_t>(!function.empty()));
  out.array(std::span<const vec3>(function.values));
}

sh::RadianceSh read_sh(ByteReader& in, const char* what, int degree, bool may_be_empty) {
  const auto present = in.value_in<std::uint8_t>(what, may_be_empty ? 0 : 1, 1);
  if (!present) return {};
  sh::RadianceSh function(degree);
  in.array(what, function.values);
  return function;
}

void write_groups(ByteWriter& out, const std::vector<GroupLight>& groups) {
  for (const GroupLight& group : groups) {
    write_sh(out, group.emitted);
    write_sh(out, group.reflected);
  }
}

std::vector<GroupLight> read_groups(ByteReader& in, int degree, std::size_t group_count) {
  std::vector<GroupLight> groups(group_count);
  for (GroupLight& group : groups) {
    group.emitted = read_sh(in, "emitted", degree, true);
    group.reflected = read_sh(in, "reflected", degree, false);
  }
  return groups;
}

void write_edges(ByteWriter& out, const std::vector<Edge>& edges) {
  out.value(static_cast<std::uint32_t>(edges.size()));
  for (const Edge& edge : edges) {
    out.value(static_cast<std::uint32_t>(edge.from));
    out.value(edge.transfer);
    write_sh(out, edge.h);
    out.value(static_cast<std::uint8_t>(!edge.matrix.values.empty()));
    out.array(std::span<const vec3>(edge.matrix.values));
  }
}

std::vector<Edge> read_edges(ByteReader& in, int degree, std::size_t index, std::size_t probe_count) {
  const auto k = static_cast<std::size_t>(sh::coefficient_count(degree));
  const std::size_t bytes_each = 2 * sizeof(std::uint32_t) + 2 + k * sizeof(vec3);
  std::vector<Edge> edges(in.count("edge count", probe_count == 0 ? 0 : probe_count - 1, bytes_each));
  std::int64_t last = -1;
  for (Edge& edge : edges) {
    const auto from = in.value<std::uint32_t>("edge source");
    if (from >= probe_count || from == index || from <= last) {
      in.fail("edge source", "must be another probe's index, in ascending order");
    }
    last = from;
    edge.from = static_cast<int>(from);
    edge.transfer = in.value_in<float>("transfer P", 0.0f, 1.0f);
    edge.h = read_sh(in, "H", degree, false);
    if (in.value_in<std::uint8_t>("matrix flag", 0, 1)) {
      if (k * k * sizeof(vec3) > in.left()) in.fail("matrix", "is cut off");
      edge.matrix = sh::TransferMatrix(degree, degree);
      in.array("matrix", edge.matrix.values);
    }
  }
  return edges;
}

void write_fitted(ByteWriter& out, const FittedPoints& fitted) {
  out.value(static_cast<std::uint32_t>(fitted.points.size()));
  for (std::size_t i = 0; i < fitted.points.size(); ++i) {
    out.vector3(fitted.points[i].position);
    out.vector3(fitted.points[i].normal);
    out.value(static_cast<std::uint8_t>(fitted.weights[i].count));
    for (const ProbeWeight& entry : fitted.weights[i].used()) {
      out.value(static_cast<std::uint32_t>(entry.probe));
      out.value(entry.weight);
    }
  }
}

FittedPoints read_fitted(ByteReader& in, std::size_t probe_count) {
  const std::size_t count = in.count("fitted point count", limits::fitted_points, 2 * sizeof(vec3) + 1);
  FittedPoints fitted;
  fitted.points.resize(count);
  fitted.weights.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    fitted.points[i].position = in.vector3("fitted point");
    fitted.points[i].normal = in.vector3("fitted normal");
    PointWeights& weights = fitted.weights[i];
    weights.count = in.value_in<std::uint8_t>("fitted weight count", 0, max_weights);
    for (int k = 0; k < weights.count; ++k) {
      const auto probe = in.value<std::uint32_t>("fitted probe");
      if (probe >= probe_count) in.fail("fitted probe", "must be a probe's index");
      weights.entries[static_cast<std::size_t>(k)] = {
          static_cast<int>(probe), in.value_in<float>("fitted weight", 0, limits::fitted_weight)};
    }
  }
  return fitted;
}

}  // namespace ssphh::gi
