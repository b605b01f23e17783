/// Jobs of transport and their results as messages.

#include <cmath>

#include "codec_parts.h"

namespace ssphh::farm {
namespace {

// --- parameters

json::Value put(const transport::TransportParams& p) {
  return {{"directions", p.directions},
          {"surfel_size", exact(p.surfel_size)},
          {"link_rays", p.link_rays},
          {"samples", p.samples},
          {"surfels_per_radius", exact(p.surfels_per_radius)},
          {"most_surfels", p.most_surfels},
          {"grow", p.grow}};
}

int count(const Field& f, const char* name) {
  return static_cast<int>(f[name].integer(0, INT32_MAX));
}

transport::TransportParams get_transport(const Field& f) {
  transport::TransportParams p;
  p.directions = count(f, "directions");
  p.surfel_size = f["surfel_size"].number();
  p.link_rays = count(f, "link_rays");
  p.samples = count(f, "samples");
  p.surfels_per_radius = f["surfels_per_radius"].number();
  p.most_surfels = count(f, "most_surfels");
  p.grow = f["grow"].boolean();
  return p;
}

json::Value put(const transport::SolveParams& p) {
  return {{"tolerance", exact(p.tolerance)}, {"max_iterations", p.max_iterations}, {"settle", p.settle}};
}

transport::SolveParams get_solve(const Field& f) {
  return {f["tolerance"].number(), count(f, "max_iterations"), f["settle"].boolean()};
}

json::Value put(const transport::LinkVizParams& p) {
  return {{"neighbors", p.neighbors},
          {"threshold", exact(p.threshold)},
          {"source", name_of(p.source)},
          {"solve", put(p.solve)}};
}

transport::LinkVizParams get_viz(const Field& f) {
  return {static_cast<int>(f["neighbors"].integer(-1, INT32_MAX)), f["threshold"].number(),
          f["source"].named<probes::VizSource>(), get_solve(f["solve"])};
}

/// null where a box has no end.
json::Value corner(const vec3& at) {
  json::Array values;
  for (int axis = 0; axis < 3; ++axis)
    values.push_back(std::isfinite(at[axis]) ? exact(at[axis]) : json::Value());
  return values;
}

vec3 get_corner(const Field& f, const vec3& no_end) {
  vec3 at = no_end;
  f.size(3, 3);
  for (int axis = 0; axis < 3; ++axis)
    if (!f[axis].value().is_null()) at[axis] = f[axis].number();
  return at;
}

json::Value put(const transport::GatherParams& p) {
  return {{"points", p.points},
          {"rays", p.rays},
          {"poses", p.poses},
          {"baked", p.baked},
          {"min", corner(p.within.min)},
          {"max", corner(p.within.max)}};
}

transport::GatherParams get_records(const Field& f) {
  transport::GatherParams p{count(f, "points"), count(f, "rays"), count(f, "poses")};
  for (const Field& group : json::elements(f["baked"], 0, 256))
    p.baked.push_back(static_cast<int>(group.integer(0, 255)));
  p.within = {get_corner(f["min"], p.within.min), get_corner(f["max"], p.within.max)};
  return p;
}

// --- records: light of a group as one array of scales and one of the integers, nine a point

json::Value put(const std::vector<probes::PackedRecordLight>& light, MessageWriter& out) {
  std::vector<float> scales, values;
  for (const probes::PackedRecordLight& l : light) {
    scales.push_back(l.scale);
    for (const std::int16_t value : l.values) values.push_back(static_cast<float>(value));
  }
  return {{"scales", out.floats(scales)}, {"values", out.floats(values)}};
}

std::vector<probes::PackedRecordLight> get_record_light(const Field& f) {
  const Field scales_at = f["scales"], values_at = f["values"];
  std::vector<float> scales(scales_at.float_count()), values(values_at.float_count());
  if (values.size() != 9 * scales.size()) values_at.fail("must be nine for each scale");
  scales_at.floats(scales), values_at.floats(values);
  std::vector<probes::PackedRecordLight> light(scales.size());
  for (std::size_t p = 0; p < light.size(); ++p) {
    light[p].scale = scales[p];
    for (std::size_t k = 0; k < 9; ++k) {
      const float value = values[9 * p + k];
      if (!(std::abs(value) <= 32767)) values_at.fail("must lie in -32767..32767");
      light[p].values[k] = static_cast<std::int16_t>(value);
    }
  }
  return light;
}

json::Value put(const probes::SurfaceRecords& records, MessageWriter& out) {
  std::vector<vec3> positions, normals;
  for (const rays::SurfacePoint& point : records.points) {
    positions.push_back(point.position);
    normals.push_back(point.normal);
  }
  json::Value groups = json::Value::array(), direct = json::Value::array();
  for (const auto& light : records.groups) groups.push_back(put(light, out));
  for (const auto& light : records.direct) direct.push_back(put(light, out));
  return {{"positions", out.vectors(positions)},
          {"normals", out.vectors(normals)},
          {"groups", groups},
          {"direct", direct}};
}

std::vector<vec3> get_vectors(const Field& f) {
  const std::size_t floats = f.float_count();
  if (floats % 3 != 0) f.fail("must be x, y, z of each point");
  std::vector<vec3> values(floats / 3);
  f.vectors(values);
  return values;
}

probes::SurfaceRecords get_surface(const Field& f) {
  const std::vector<vec3> positions = get_vectors(f["positions"]), normals = get_vectors(f["normals"]);
  if (normals.size() != positions.size()) f["normals"].fail("must be one for each position");
  probes::SurfaceRecords records;
  for (std::size_t p = 0; p < positions.size(); ++p) records.points.push_back({positions[p], normals[p]});
  for (const Field& group : json::elements(f["groups"], 0, 256))
    records.groups.push_back(get_record_light(group));
  for (const Field& group : json::elements(f["direct"], 0, 256))
    records.direct.push_back(get_record_light(group));
  try {
    probes::require_whole(records, records.groups.size());
  } catch (const Error& e) {
    f.fail(e.problem());
  }
  return records;
}

// --- what it took

json::Value put(const bake::TransportBakeReport& r) {
  return {{"surfels", r.surfels},
          {"links", r.links},
          {"finest_surfel", exact(r.finest_surfel)},
          {"coarsest_surfel", exact(r.coarsest_surfel)},
          {"iterations", r.iterations},
          {"contraction", r.contraction},
          {"error", exact(r.error)},
          {"lost", r.lost},
          {"records", r.records},
          {"seconds", r.seconds},
          {"viz_seconds", r.viz_seconds},
          {"record_seconds", r.record_seconds},
          {"rays", r.rays},
          {"warnings", r.warnings}};
}

bake::TransportBakeReport get_report(const Field& f) {
  const auto number = [&](const char* name) {
    return static_cast<std::uint64_t>(f[name].integer(0, INT64_MAX));
  };
  bake::TransportBakeReport r;
  r.surfels = number("surfels");
  r.links = number("links");
  r.finest_surfel = f["finest_surfel"].number();
  r.coarsest_surfel = f["coarsest_surfel"].number();
  r.iterations = count(f, "iterations");
  r.contraction = f["contraction"].precise_number();
  r.error = f["error"].number();
  r.lost = f["lost"].precise_number();
  r.records = number("records");
  r.seconds = f["seconds"].precise_number();
  r.viz_seconds = f["viz_seconds"].precise_number();
  r.record_seconds = f["record_seconds"].precise_number();
  r.rays = number("rays");
  for (const Field& warning : json::elements(f["warnings"], 0, 1000)) r.warnings.push_back(warning.text());
  return r;
}

}  // namespace

json::Value put(const TransportJob& job, MessageWriter& out) {
  const bake::TransportBakeParams& p = job.params;
  return {{"scene", put(job.scene)},
          {"degree", job.degree},
          {"light_known", job.light_known},
          {"transport", put(p.transport)},
          {"solve", put(p.solve)},
          {"edges", p.viz},
          {"viz", put(p.viz_params)},
          {"records", put(p.records)},
          {"own", p.own_probes},
          {"places", put(std::span<const ProbeSphere>(job.places), out)}};
}

TransportJob get_transport_job(const Field& f) {
  TransportJob job;
  job.scene = get_scene(f["scene"]);
  job.degree = static_cast<int>(f["degree"].integer(0, sh::max_degree));
  job.light_known = f["light_known"].boolean();
  bake::TransportBakeParams& p = job.params;
  p.transport = get_transport(f["transport"]);
  p.solve = get_solve(f["solve"]);
  p.viz = f["edges"].boolean();
  p.viz_params = get_viz(f["viz"]);
  p.records = get_records(f["records"]);
  p.own_probes = static_cast<std::size_t>(f["own"].integer(0, INT32_MAX));
  job.places = get_places(f["places"], job_limits::tile_places);
  return job;
}

json::Value put(const TransportJobResult& result, MessageWriter& out) {
  json::Value light = json::Value::array(), edges = json::Value::array();
  for (const auto& probe : result.light) light.push_back(put(probe, out));
  for (const auto& probe : result.edges) edges.push_back(put(probe, out));
  json::Value object = {{"degree", result.degree},
                        {"light_groups", result.light_groups},
                        {"surfel_size", exact(result.surfel_size)},
                        {"light", light},
                        {"edges", edges},
                        {"report", put(result.report)}};
  if (result.records) object["records"] = put(*result.records, out);
  return object;
}

TransportJobResult get_transport_result(const Field& f) {
  TransportJobResult result;
  result.degree = static_cast<int>(f["degree"].integer(0, sh::max_degree));
  for (const Field& group : json::elements(f["light_groups"], 0, 256))
    result.light_groups.push_back(group.text(1024));
  result.surfel_size = f["surfel_size"].number();
  for (const Field& probe : json::elements(f["light"], 0, job_limits::tile_places))
    result.light.push_back(get_light(probe, result.degree));
  for (const Field& probe : json::elements(f["edges"], 0, job_limits::tile_places))
    result.edges.push_back(
        probes::read_edges(FieldParts(probe), result.degree, result.edges.size(), job_limits::tile_places));
  if (const auto records = f.find("records")) result.records = get_surface(*records);
  result.report = get_report(f["report"]);
  return result;
}

}  // namespace ssphh::farm
