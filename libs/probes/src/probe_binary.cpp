/// File: magic (8 bytes), version (u32), payload size (u64), checksum of the payload (2×u64), payload.

#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>

#include <fmt/format.h>

#include <ssphh/core/hash.h>
#include <ssphh/probes/byte_parts.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/probes/probe_limits.h>

#include "probe_finish.h"

namespace ssphh::probes {
namespace {

/// As PNG's: tells text-mode transfers and truncation at Ctrl-Z.
constexpr std::array<char, 8> magic = {'S', 'P', 'H', 'L', '\r', '\n', '\x1a', '\n'};

/// Magic, version, size and checksum of the payload; a packed file's payload begins with the packing.
constexpr std::size_t header_bytes = 36;

void write_generator(ByteWriter& out, const GeneratorInfo& g) {
  out.value(static_cast<std::uint8_t>(g.op));
  out.value(static_cast<std::uint8_t>(g.viz));
  out.value(static_cast<std::uint8_t>(g.viz_source));
  out.value(static_cast<std::uint8_t>(g.gen));
  out.value(static_cast<std::uint8_t>(g.viz_paths));
  for (const int v : {g.max_depth, g.passes, g.spp, g.viz_max_depth, g.viz_passes, g.viz_spp, g.face_size})
    out.value(static_cast<std::uint32_t>(v));
  out.value(g.seed);
  out.value(static_cast<std::uint32_t>(g.directions));
  out.value(g.surfel_size);
  out.value(static_cast<std::uint32_t>(g.link_rays));
  out.text(g.scene);
  out.value(g.scene_hash.high), out.value(g.scene_hash.low);
  out.value(g.time);
}

int read_int(ByteReader& in, const char* what, int low, int high) {
  return static_cast<int>(
      in.value_in(what, static_cast<std::uint32_t>(low), static_cast<std::uint32_t>(high)));
}

GeneratorInfo read_generator(ByteReader& in) {
  GeneratorInfo g;
  g.op = static_cast<LightOperator>(in.value_in<std::uint8_t>("operator", 0, 2));
  g.viz = static_cast<VizMethod>(in.value_in<std::uint8_t>("VIZ method", 0, 2));
  g.viz_source = static_cast<VizSource>(in.value_in<std::uint8_t>("VIZ source", 0, 1));
  g.gen = static_cast<GenMode>(in.value_in<std::uint8_t>("GEN mode", 0, 1));
  g.viz_paths = static_cast<rays::PathSet>(in.value_in<std::uint8_t>("VIZ paths", 0, 1));
  g.max_depth = read_int(in, "max depth", 0, limits::depth);
  g.passes = read_int(in, "passes", 1, limits::samples);
  g.spp = read_int(in, "samples", 1, limits::samples);
  g.viz_max_depth = read_int(in, "max depth of VIZ", 0, limits::depth);
  g.viz_passes = read_int(in, "passes of VIZ", 1, limits::samples);
  g.viz_spp = read_int(in, "samples of VIZ", 1, limits::samples);
  g.face_size = read_int(in, "face size", 1, limits::face_size);
  g.seed = in.value<std::uint64_t>("seed");
  g.directions = read_int(in, "directions", 0, limits::rays);
  g.surfel_size = in.value_in<float>("surfel size", 0, limits::coordinate);
  g.link_rays = read_int(in, "link rays", 0, limits::rays);
  g.scene = in.text("scene name", limits::text);
  g.scene_hash.high = in.value<std::uint64_t>("scene hash");
  g.scene_hash.low = in.value<std::uint64_t>("scene hash");
  g.time = in.value_in<float>("time", -limits::coordinate, limits::coordinate);
  return g;
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
      weights.entries[k] = {static_cast<int>(probe),
                            in.value_in<float>("fitted weight", 0, limits::fitted_weight)};
    }
  }
  return fitted;
}

void write_surface(ByteWriter& out, const SurfaceRecords& surface) {
  out.value(static_cast<std::uint32_t>(surface.points.size()));
  for (std::size_t g = 0; g < surface.groups.size(); ++g)
    out.value(static_cast<std::uint8_t>(surface.keeps_direct(g)));
  const auto write = [&](const PackedRecordLight& light) {
    out.value(light.scale);
    out.array(std::span<const std::int16_t>(light.values));
  };
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    out.vector3(surface.points[i].position);
    out.vector3(surface.points[i].normal);
    for (std::size_t g = 0; g < surface.groups.size(); ++g) {
      write(surface.groups[g][i]);
      if (surface.keeps_direct(g)) write(surface.direct[g][i]);
    }
  }
}

SurfaceRecords read_surface(ByteReader& in, std::size_t group_count) {
  constexpr std::size_t light_bytes = sizeof(float) + sizeof(PackedRecordLight::values);
  const std::size_t count =
      in.count("surface record count", limits::surface_records, 2 * sizeof(vec3) + group_count * light_bytes);
  SurfaceRecords surface;
  surface.points.resize(count);
  surface.groups.assign(group_count, std::vector<PackedRecordLight>(count));
  surface.direct.resize(group_count);
  for (std::vector<PackedRecordLight>& group : surface.direct)
    if (in.value_in<std::uint8_t>("direct light flag", 0, 1)) group.resize(count);
  if (std::ranges::all_of(surface.direct, &std::vector<PackedRecordLight>::empty)) surface.direct.clear();
  const auto read = [&](PackedRecordLight& light) {
    light.scale = in.value_in<float>("surface record's scale", 0, limits::coefficient);
    for (std::int16_t& v : light.values)
      v = in.value_in<std::int16_t>("surface record's light", -32767, 32767);
  };
  for (std::size_t i = 0; i < count; ++i) {
    surface.points[i].position = in.vector3("surface record");
    surface.points[i].normal = in.vector3("surface record's normal");
    for (std::size_t g = 0; g < group_count; ++g) {
      read(surface.groups[g][i]);
      if (surface.keeps_direct(g)) read(surface.direct[g][i]);
    }
  }
  return surface;
}

void write_hash(ByteWriter& out, const Hash128& hash) {
  out.value(hash.high), out.value(hash.low);
}

Hash128 read_hash(ByteReader& in, const char* what) {
  const auto high = in.value<std::uint64_t>(what);
  return {high, in.value<std::uint64_t>(what)};
}

void write_baseline(ByteWriter& out, const Baseline& baseline) {
  out.value(static_cast<std::int32_t>(baseline.viz_neighbors));
  out.value(baseline.viz_threshold);
  out.value(static_cast<std::uint32_t>(baseline.records));
  out.value(static_cast<std::uint32_t>(baseline.most_surfels));
  out.value(static_cast<std::uint32_t>(baseline.items.size()));
  for (const scene::SceneItem& item : baseline.items) {
    out.value(static_cast<std::uint8_t>(item.kind));
    out.text(item.name);
    for (const Hash128& hash : {item.shape, item.place, item.surface, item.emission}) write_hash(out, hash);
  }
  out.value(static_cast<std::uint8_t>(!baseline.trials.empty()));
  for (const Trial& trial : baseline.trials) {
    for (const std::vector<sh::RadianceSh>& half : trial.halves) {
      for (const sh::RadianceSh& light : half)
        ByteWriterParts(out).vectors("trial", light.values, Missing::never);
    }
  }
}

Baseline read_baseline(ByteReader& in, std::size_t probe_count, std::size_t group_count) {
  Baseline baseline;
  baseline.viz_neighbors = in.value_in<std::int32_t>("neighbors", -1, static_cast<int>(limits::probes));
  baseline.viz_threshold = in.value_in<float>("threshold", 0.0f, limits::coefficient);
  baseline.records = read_int(in, "records", 0, static_cast<int>(limits::surface_records));
  baseline.most_surfels = read_int(in, "surfels", 0, limits::surfels);
  constexpr std::size_t item_bytes = 1 + sizeof(std::uint32_t) + 4 * sizeof(Hash128);
  baseline.items.resize(in.count("scene item count", limits::scene_items, item_bytes));
  for (scene::SceneItem& item : baseline.items) {
    item.kind = static_cast<scene::ItemKind>(in.value_in<std::uint8_t>("kind of scene item", 0, 2));
    item.name = in.text("name of scene item", limits::text);
    for (Hash128* hash : {&item.shape, &item.place, &item.surface, &item.emission})
      *hash = read_hash(in, "hash of scene item");
  }
  constexpr auto coefficients = static_cast<std::size_t>(sh::coefficient_count(trial_degree));
  if (in.value_in<std::uint8_t>("trials flag", 0, 1)) baseline.trials.resize(probe_count);
  for (Trial& trial : baseline.trials) {
    for (std::vector<sh::RadianceSh>& half : trial.halves) {
      half.resize(group_count);
      for (sh::RadianceSh& light : half)
        light.values = ByteReaderParts(in).vectors("trial", coefficients, Missing::never);
    }
  }
  return baseline;
}

ProbeSet read_payload(ByteReader& in, sh::Packing packing) {
  ProbeSet set;
  set.degree = read_int(in, "degree", 0, sh::max_degree);
  if (!sh::packs(packing, set.degree)) in.fail("packing", "has no such degree");
  const auto coefficients = static_cast<std::size_t>(sh::coefficient_count(set.degree));
  set.generator = read_generator(in);
  set.light_groups.resize(
      in.count("light group count", limits::light_groups, sizeof(std::uint32_t) + sizeof(vec3) + 1));
  for (LightGroup& group : set.light_groups) {
    group.name = in.text("light group name", limits::text);
    group.scale = in.vector3("light group scale");
    group.mode = static_cast<scene::LightMode>(in.value_in<std::uint8_t>("light group mode", 0, 3));
  }
  const std::size_t bytes_each = set.light_groups.size() * (sh::packed_bytes(packing, set.degree) + 2) +
                                 sizeof(vec3) + 3 * sizeof(float);
  const std::size_t probe_count = in.count("probe count", limits::probes, bytes_each);
  set.probes.resize(probe_count);
  for (std::size_t i = 0; i < probe_count; ++i) {
    Probe& probe = set.probes[i];
    probe.name = in.text("probe name", limits::text);
    probe.position = in.vector3("position");
    probe.radius = in.value<float>("radius");
    probe.groups = read_groups(in, set.degree, set.light_groups.size(), packing);
    probe.edges = read_edges(ByteReaderParts(in), set.degree, i, probe_count);
  }
  if (in.value_in<std::uint8_t>("hierarchy flag", 0, 1)) {
    Hierarchy& hierarchy = set.hierarchy.emplace();
    hierarchy.op = static_cast<HierOperator>(in.value_in<std::uint8_t>("operator", 0, 3));
    hierarchy.neighbors = in.value_in<std::int32_t>("neighbors", -1, static_cast<int>(limits::probes));
    hierarchy.threshold = in.value_in<float>("threshold", 0.0f, limits::coefficient);
    hierarchy.neighbor.resize(probe_count);
    for (sh::RadianceSh& neighbor : hierarchy.neighbor)
      neighbor.values = ByteReaderParts(in, packing).vectors("neighbour part", coefficients, Missing::never);
  }
  if (in.value_in<std::uint8_t>("fitted flag", 0, 1)) set.fitted = read_fitted(in, probe_count);
  if (in.value_in<std::uint8_t>("surface flag", 0, 1))
    set.surface = read_surface(in, set.light_groups.size());
  if (in.value_in<std::uint8_t>("baseline flag", 0, 1))
    set.baseline = read_baseline(in, probe_count, set.light_groups.size());
  in.expect_end();
  return set;
}

Hash128 checksum(std::span<const std::byte> payload) {
  return Hasher().bytes(payload).finish();
}

}  // namespace

std::vector<std::byte> probes_to_binary(const ProbeSet& set, sh::Packing packing) {
  validate(set, "probe set");
  const bool packed = packing != sh::Packing::none;
  if (packed) {
    require(edge_count(set) == 0 && !set.baseline, "packed probe set", "it holds no edges and no baseline");
    if (!sh::packs(packing, set.degree))
      refuse("packed probe set", fmt::format("{} has no degree {}", name_of(packing), set.degree));
  }
  ByteWriter payload;
  if (packed) payload.value(static_cast<std::uint8_t>(packing));
  payload.value(static_cast<std::uint32_t>(set.degree));
  write_generator(payload, set.generator);
  payload.value(static_cast<std::uint32_t>(set.light_groups.size()));
  for (const LightGroup& group : set.light_groups) {
    payload.text(group.name);
    payload.vector3(group.scale);
    payload.value(static_cast<std::uint8_t>(group.mode));
  }
  payload.value(static_cast<std::uint32_t>(set.probes.size()));
  for (const Probe& probe : set.probes) {
    payload.text(probe.name);
    payload.vector3(probe.position);
    payload.value(probe.radius);
    try {
      write_groups(payload, probe.groups, packing);
    } catch (const Error& e) {
      throw Error(fmt::format("probe \"{}\"", probe.name), e.problem(), e.hint());
    }
    write_edges(payload, probe.edges);
  }
  payload.value(static_cast<std::uint8_t>(set.hierarchy.has_value()));
  if (set.hierarchy) {
    payload.value(static_cast<std::uint8_t>(set.hierarchy->op));
    payload.value(static_cast<std::int32_t>(set.hierarchy->neighbors));
    payload.value(set.hierarchy->threshold);
    for (const sh::RadianceSh& neighbor : set.hierarchy->neighbor)
      ByteWriterParts(payload, packing).vectors("neighbour part", neighbor.values, Missing::never);
  }
  payload.value(static_cast<std::uint8_t>(set.fitted.has_value()));
  if (set.fitted) write_fitted(payload, *set.fitted);
  payload.value(static_cast<std::uint8_t>(set.surface.has_value()));
  if (set.surface) write_surface(payload, *set.surface);
  payload.value(static_cast<std::uint8_t>(set.baseline.has_value()));
  if (set.baseline) write_baseline(payload, *set.baseline);

  ByteWriter file;
  file.array(std::span<const char>(magic));
  file.value(static_cast<std::uint32_t>(packed ? packed_probe_file_version : probe_file_version));
  file.value(static_cast<std::uint64_t>(payload.bytes().size()));
  const Hash128 sum = checksum(payload.bytes());
  file.value(sum.high), file.value(sum.low);
  file.array(std::span<const std::byte>(payload.bytes()));
  return file.bytes();
}

ProbeSet probes_from_binary(std::span<const std::byte> data, const std::string& where) {
  ByteReader header(data, where);
  if (data.size() < magic.size() ||
      !std::equal(magic.begin(), magic.end(), reinterpret_cast<const char*>(data.data()))) {
    const std::string_view text(reinterpret_cast<const char*>(data.data()),
                                std::min<std::size_t>(data.size(), 64));
    if (text.find("\"ssphh-emission\"") != text.npos) {
      throw Error(where, "is an emission file: what a thing sends out, not light that probes receive",
                  "an SPHL shines with it: docs/sphl-lights.md");
    }
    throw Error(where, "is not a binary probe file", "a JSON probe file's name must end in .json");
  }
  for (std::size_t i = 0; i < magic.size(); ++i) header.value<char>("magic");
  const auto version = header.value<std::uint32_t>("version");
  const bool packed = version == packed_probe_file_version;
  if (version != probe_file_version && !packed) {
    throw Error(where,
                fmt::format("has version {}; this program reads versions {} and {}", version,
                            probe_file_version, packed_probe_file_version),
                "bake it anew: ssphh bake SCENE -o FILE");
  }
  const auto size = header.value<std::uint64_t>("payload size");
  Hash128 sum;
  sum.high = header.value<std::uint64_t>("checksum");
  sum.low = header.value<std::uint64_t>("checksum");
  if (size != header.left()) {
    throw Error(
        where,
        "says that it holds " + std::to_string(size) + " bytes but holds " + std::to_string(header.left()),
        "the file is cut off or damaged");
  }
  const auto payload = data.last(header.left());
  if (checksum(payload) != sum) throw Error(where, "its checksum does not match", "the file is damaged");

  ByteReader in(payload, where + " payload");
  const auto packing = static_cast<sh::Packing>(packed ? in.value_in<std::uint8_t>("packing", 1, 4) : 0);
  ProbeSet set = read_payload(in, packing);
  finish_reading(set, where);
  return set;
}

sh::Packing packing_of_file(const std::filesystem::path& path) {
  if (probe_file_format(path) != ProbeFileFormat::binary) return sh::Packing::none;
  std::array<char, header_bytes + 1> begin{};
  std::ifstream file(path, std::ios::binary);
  if (!file.read(begin.data(), begin.size())) throw Error(path.string(), "cannot be read");
  ByteReader in(std::as_bytes(std::span(begin)).subspan(magic.size()), path.string());
  if (in.value<std::uint32_t>("version") != packed_probe_file_version) return sh::Packing::none;
  return static_cast<sh::Packing>(begin[header_bytes]);
}

}  // namespace ssphh::probes
