#include <fmt/format.h>

#include "codec_parts.h"

namespace ssphh::farm {

// --- parts of several kinds

json::Value put(const SceneRef& scene) {
  return {{"package", scene.package.hex()},
          {"manifest_bytes", scene.manifest_bytes},
          {"light_hash", scene.light.hex()},
          {"time", exact(scene.time)}};
}

SceneRef get_scene(const Field& f) {
  SceneRef scene;
  scene.package = f["package"].hash();
  scene.manifest_bytes = static_cast<std::uint64_t>(f["manifest_bytes"].integer(1, std::int64_t{1} << 40));
  scene.light = f["light_hash"].hash();
  scene.time = f["time"].number();
  return scene;
}

json::Value put(std::span<const ProbeSphere> places, MessageWriter& out) {
  if (places.empty()) return json::Value::array();
  std::vector<float> values;
  for (const ProbeSphere& p : places)
    values.insert(values.end(), {p.position.x, p.position.y, p.position.z, p.radius});
  return out.floats(values);
}

std::vector<ProbeSphere> get_places(const Field& f, std::size_t most) {
  const std::size_t floats = f.float_count();
  if (floats % 4 != 0 || floats > 4 * most) f.fail("must be x, y, z, radius of each place");
  std::vector<float> values(floats);
  f.floats(values);
  std::vector<ProbeSphere> places;
  for (std::size_t i = 0; i < floats; i += 4)
    places.push_back({{values[i], values[i + 1], values[i + 2]}, values[i + 3]});
  return places;
}

namespace {

template <class Part, class Write>
json::Value put_each(const std::vector<Part>& parts, MessageWriter& out, const Write& write) {
  json::Value list = json::Value::array();
  for (const Part& part : parts) {
    list.push_back(json::Value::object());
    write(MessageParts{list[list.size() - 1], out}, part);
  }
  return list;
}

}  // namespace

json::Value put(const std::vector<probes::GroupLight>& light, MessageWriter& out) {
  return put_each(light, out,
                  [](MessageParts to, const probes::GroupLight& l) { probes::write_light(to, l); });
}

json::Value put(const std::vector<probes::Edge>& edges, MessageWriter& out) {
  return put_each(edges, out,
                  [](MessageParts to, const probes::Edge& edge) { probes::write_edge(to, edge); });
}

std::vector<probes::GroupLight> get_light(const Field& f, int degree) {
  std::vector<probes::GroupLight> light;
  for (const Field& group : json::elements(f, 0, 256))
    light.push_back(probes::read_light(FieldParts(group), degree));
  return light;
}

namespace {

// --- paths

json::Value put(const rays::PathParams& path) {
  return {{"max_depth", path.max_depth},
          {"passes", path.passes},
          {"spp", path.spp},
          {"seed", fmt::format("{:x}", path.seed)}};
}

rays::PathParams get_path(const Field& f) {
  const auto number = [&](const char* key) { return static_cast<int>(f[key].integer(0, INT32_MAX)); };
  return {number("max_depth"), number("passes"), number("spp"), f["seed"].hexadecimal()};
}

// --- probes

json::Value put(const ProbeJob& job, MessageWriter& out) {
  return {{"scene", put(job.scene)},
          {"renderer", name_of(job.renderer)},
          {"degree", job.degree},
          {"face_size", job.face_size},
          {"path", put(job.path)},
          {"viz",
           {{"matrix", job.viz_params.matrix},
            {"neighbors", job.viz_params.neighbors},
            {"threshold", exact(job.viz_params.threshold)},
            {"source", name_of(job.viz_params.source)},
            {"paths", name_of(job.viz_params.paths)}}},
          {"probes", job.probes},
          {"places", put(job.places, out)}};
}

ProbeJob get_probe_job(const Field& f, bake::BakeStage stage) {
  ProbeJob job;
  job.stage = stage;
  job.scene = get_scene(f["scene"]);
  job.renderer = f["renderer"].named<Renderer>();
  job.degree = static_cast<int>(f["degree"].integer(0, sh::max_degree));
  job.face_size = static_cast<int>(f["face_size"].integer(1, 4096));
  job.path = get_path(f["path"]);
  const Field viz = f["viz"];
  job.viz_params = {viz["matrix"].boolean(), static_cast<int>(viz["neighbors"].integer(-1, INT32_MAX)),
                    viz["threshold"].number(), viz["source"].named<probes::VizSource>(),
                    viz["paths"].named<rays::PathSet>()};
  for (const Field& probe : json::elements(f["probes"], 0, job_limits::units))
    job.probes.push_back(static_cast<std::uint32_t>(probe.integer(0, job_limits::places - 1)));
  job.places = get_places(f["places"], job_limits::places);
  return job;
}

json::Value put(const bake::ProbeStageResult& result, MessageWriter& out) {
  json::Value probe = {{"probe", result.done.probe}, {"seconds", result.seconds}, {"rays", result.rays}};
  if (result.done.stage == bake::BakeStage::gen) {
    probe["groups"] = put(result.groups, out);
  } else {
    probe["edges"] = put(result.edges, out);
  }
  return probe;
}

bake::ProbeStageResult get_probe(const Field& f, bake::BakeStage stage, int degree) {
  bake::ProbeStageResult result;
  result.done = {stage, static_cast<std::uint32_t>(f["probe"].integer(0, job_limits::places - 1))};
  result.seconds = f["seconds"].precise_number();
  result.rays = static_cast<std::uint64_t>(f["rays"].integer(0, INT64_MAX));
  if (stage == bake::BakeStage::viz) {
    result.edges = probes::read_edges(FieldParts(f["edges"]), degree, result.done.probe, job_limits::places);
    return result;
  }
  result.groups = get_light(f["groups"], degree);
  return result;
}

// --- tiles

json::Value put(const trace::Tile& t) {
  return json::Value::array({t.x, t.y, t.width, t.height});
}

trace::Tile get_tile(const Field& f) {
  if (f.size() != 4) f.fail("must be [x, y, width, height]");
  const auto n = [&](std::size_t i) { return static_cast<int>(f[i].integer(0, job_limits::picture_size)); };
  return {n(0), n(1), n(2), n(3)};
}

json::Value put(const TileJob& job, MessageWriter& out) {
  const trace::RenderParams& p = job.params;
  const scene::Camera& camera = p.camera.camera;
  json::Value tiles = json::Value::array();
  for (const trace::Tile& tile : job.tiles) tiles.push_back(put(tile));
  json::Value layers = json::Value::array();
  for (const trace::RenderLayer layer : job.layers) layers.push_back(name_of(layer));
  json::Value document = {{"scene", put(job.scene)},
                          {"width", p.width},
                          {"height", p.height},
                          {"camera",
                           {{"world", out.floats({&p.camera.world[0][0], 16})},
                            {"orthographic", camera.orthographic},
                            {"yfov", exact(camera.yfov)},
                            {"yheight", exact(camera.yheight)}}},
                          {"projection", name_of(p.projection)},
                          {"path", put(p.path)},
                          {"layers", layers},
                          {"tiles", tiles}};
  if (job.lighting) {
    const ProbeLighting& l = *job.lighting;
    document["lighting"] = {{"probes", l.probes.hex()},
                            {"bytes", l.bytes},
                            {"lookup", name_of(l.lookup.method)},
                            {"weights", l.lookup.weights ? name_of(*l.lookup.weights) : ""},
                            {"layer", name_of(l.lookup.layer)}};
  }
  return document;
}

probes::LookupSpec get_lookup(const Field& f) {
  probes::LookupSpec lookup;
  lookup.method = f["lookup"].named<probes::LookupMethod>();
  if (!f["weights"].text().empty()) lookup.weights = f["weights"].named<probes::WeightMethod>();
  lookup.layer = f["layer"].named<probes::ProbeLayer>();
  return lookup;
}

TileJob get_tile_job(const Field& f) {
  TileJob job;
  job.scene = get_scene(f["scene"]);
  trace::RenderParams& p = job.params;
  p.width = static_cast<int>(f["width"].integer(1, job_limits::picture_size));
  p.height = static_cast<int>(f["height"].integer(1, job_limits::picture_size));
  const Field camera = f["camera"];
  camera["world"].floats({&p.camera.world[0][0], 16});
  p.camera.camera.orthographic = camera["orthographic"].boolean();
  p.camera.camera.yfov = camera["yfov"].number();
  p.camera.camera.yheight = camera["yheight"].number();
  p.projection = f["projection"].named<trace::Projection>();
  p.path = get_path(f["path"]);
  for (const Field& layer : json::elements(f["layers"], 0, trace::render_layers().size()))
    job.layers.push_back(layer.named<trace::RenderLayer>());
  p.per_group = !job.layers.empty() && job.layers.back() == trace::RenderLayer::groups;
  for (const Field& tile : json::elements(f["tiles"], 0, job_limits::units))
    job.tiles.push_back(get_tile(tile));
  if (const auto l = f.find("lighting")) {
    job.lighting = {(*l)["probes"].hash(),
                    static_cast<std::uint64_t>((*l)["bytes"].integer(1, std::int64_t{1} << 40)),
                    get_lookup(*l)};
  }
  return job;
}

json::Value put(const TileResult& result, MessageWriter& out) {
  const trace::RenderState& state = result.state;
  json::Value layers = json::Value::object();
  for (const trace::RenderLayer layer : trace::render_layers()) {
    for (const image::Image& image : trace::images_of(state, layer)) {
      if (layer == trace::RenderLayer::groups) {
        layers[name_of(layer)].push_back(out.floats(image.pixels));
      } else if (!image.empty()) {
        layers[name_of(layer)] = out.floats(image.pixels);
      }
    }
  }
  return {{"tile", put(result.tile)},
          {"passes", state.passes_done},
          {"paths", state.paths},
          {"rays", state.rays},
          {"layers", layers}};
}

TileResult get_tile_result(const Field& f) {
  TileResult result;
  result.tile = get_tile(f["tile"]);
  const trace::Tile& t = result.tile;
  if (t.width < 1 || t.height < 1 || t.width > job_limits::tile_size || t.height > job_limits::tile_size)
    f["tile"].fail("must be 1 to 1024 pixels wide and high");
  const auto pixels = static_cast<std::size_t>(t.width) * static_cast<std::size_t>(t.height);
  const auto read = [&](const Field& layer, int channels) {
    if (layer.float_count() != pixels * static_cast<std::size_t>(channels)) layer.fail("has a wrong count");
    image::Image image(t.width, t.height, channels);
    layer.floats(image.pixels);
    return image;
  };
  trace::RenderState& state = result.state;
  state.passes_done = static_cast<int>(f["passes"].integer(0, INT32_MAX));
  state.paths = static_cast<std::uint64_t>(f["paths"].integer(0, INT64_MAX));
  state.rays = static_cast<std::uint64_t>(f["rays"].integer(0, INT64_MAX));
  const Field layers = f["layers"];
  for (const trace::RenderLayer layer : trace::render_layers()) {
    const auto there = layers.find(name_of(layer).data());
    if (!there) continue;
    if (layer == trace::RenderLayer::groups) {
      for (const Field& group : json::elements(*there, 0, 256)) state.groups.push_back(read(group, 3));
    } else {
      trace::images_of(state, layer)[0] = read(*there, trace::channels_of(layer));
    }
  }
  return result;
}

// --- all

bake::BakeStage stage_of(JobKind kind) {
  return kind == JobKind::gen ? bake::BakeStage::gen : bake::BakeStage::viz;
}

}  // namespace

std::string encode_job(const Job& job, ContentType type) {
  validate(job);
  MessageWriter out(type);
  json::Value document = {{"format", "ssphh-job"}, {"version", job_version}, {"kind", name_of(kind_of(job))}};
  document.update(std::visit([&](const auto& j) { return put(j, out); }, job));
  return out.finish(document);
}

Job decode_job(std::string_view body) {
  const Message message = parse_message(body, "job");
  const Field root = message.root();
  root.expect_format("ssphh-job", job_version);
  const auto kind = root["kind"].named<JobKind>();
  Job job;
  switch (kind) {
    case JobKind::ref:
      job = get_tile_job(root);
      break;
    case JobKind::transport:
      job = get_transport_job(root);
      break;
    case JobKind::gen:
    case JobKind::viz:
      job = get_probe_job(root, stage_of(kind));
  }
  validate(job);
  return job;
}

std::string encode_result(const JobResult& result, ContentType type) {
  MessageWriter out(type);
  json::Value document = {{"format", "ssphh-result"}, {"version", job_version}};
  if (const auto* probes = std::get_if<ProbeJobResult>(&result.data)) {
    document["kind"] = name_of(probes->stage);
    document["degree"] = probes->degree;
    json::Value& list = document["probes"] = json::Value::array();
    for (const bake::ProbeStageResult& probe : probes->probes) list.push_back(put(probe, out));
  } else if (const auto* transport = std::get_if<TransportJobResult>(&result.data)) {
    document["kind"] = name_of(JobKind::transport);
    document.update(put(*transport, out));
  } else {
    document["kind"] = name_of(JobKind::ref);
    json::Value& list = document["tiles"] = json::Value::array();
    for (const TileResult& tile : std::get<TileJobResult>(result.data).tiles) list.push_back(put(tile, out));
  }
  document["stats"] = {
      {"seconds", result.stats.seconds}, {"rays", result.stats.rays}, {"worker", result.stats.worker}};
  return out.finish(document);
}

JobResult decode_result(std::string_view body) {
  const Message message = parse_message(body, "result");
  const Field root = message.root();
  root.expect_format("ssphh-result", job_version);
  JobResult result;
  const auto kind = root["kind"].named<JobKind>();
  if (kind == JobKind::ref) {
    auto& tiles = result.data.emplace<TileJobResult>().tiles;
    for (const Field& tile : json::elements(root["tiles"], 0, job_limits::units))
      tiles.push_back(get_tile_result(tile));
  } else if (kind == JobKind::transport) {
    result.data = get_transport_result(root);
  } else {
    auto& probes = result.data.emplace<ProbeJobResult>();
    probes.stage = stage_of(kind);
    probes.degree = static_cast<int>(root["degree"].integer(0, sh::max_degree));
    for (const Field& probe : json::elements(root["probes"], 0, job_limits::units))
      probes.probes.push_back(get_probe(probe, probes.stage, probes.degree));
  }
  const Field stats = root["stats"];
  result.stats = {stats["seconds"].precise_number(),
                  static_cast<std::uint64_t>(stats["rays"].integer(0, INT64_MAX)), stats["worker"].text()};
  return result;
}

}  // namespace ssphh::farm
