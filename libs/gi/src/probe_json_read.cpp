#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <ssphh/gi/probe_file.h>

#include "probe_finish.h"
#include "probe_limits.h"

namespace ssphh::gi {
namespace {

using nlohmann::json;

/// A JSON value and the pointer that leads to it.
class Place {
 public:
  Place(const json& value, const std::string& file, std::string pointer)
      : value_(value), file_(file), pointer_(std::move(pointer)) {}

  [[noreturn]] void fail(const std::string& problem) const {
    throw Error(file_ + " at " + (pointer_.empty() ? "/" : pointer_), problem);
  }
  bool is_object_with(const char* key) const { return value_.is_object() && value_.contains(key); }
  void require_version(int version) const {
    if (value_.is_number() && value_.get<double>() == version) return;
    fail(fmt::format("the version is {:.32}; this program reads version {}",
                     value_.dump(-1, ' ', false, json::error_handler_t::replace), version));
  }
  Place operator[](const char* key) const {
    const auto found = value_.find(key);
    if (found == value_.end()) fail(std::string("has no \"") + key + "\"");
    return {*found, file_, pointer_ + "/" + key};
  }
  Place at(std::size_t i) const { return {value_[i], file_, pointer_ + "/" + std::to_string(i)}; }

  /// An object with exactly the keys `required` and perhaps some of `optional`.
  const Place& object(std::initializer_list<std::string_view> required,
                      std::initializer_list<std::string_view> optional = {}) const {
    if (!value_.is_object()) fail("must be an object");
    const auto in = [](std::initializer_list<std::string_view> keys, std::string_view key) {
      return std::find(keys.begin(), keys.end(), key) != keys.end();
    };
    for (const std::string_view key : required) {
      if (!value_.contains(key)) fail(fmt::format("has no \"{}\"", key));
    }
    for (const auto& [key, unused] : value_.items()) {
      if (!in(required, key) && !in(optional, key)) fail(fmt::format("has the unknown key \"{:.64}\"", key));
    }
    return *this;
  }
  std::size_t array(std::size_t low, std::size_t high) const {
    if (!value_.is_array()) fail("must be an array");
    if (value_.size() < low || value_.size() > high) {
      fail(low == high ? fmt::format("has {} entries, must have {}", value_.size(), low)
                       : fmt::format("has {} entries, must have {}..{}", value_.size(), low, high));
    }
    return value_.size();
  }
  int integer(int low, int high) const {
    // 3.0 is an integer to JSON Schema, so it is one here.
    const double v = value_.is_number() ? value_.get<double>() : 0;
    if (!value_.is_number() || v != std::floor(v) || v < low || v > high) {
      fail(fmt::format("must be an integer in {}..{}", low, high));
    }
    return static_cast<int>(v);
  }
  float number(double low, double high) const {
    if (!value_.is_number()) fail("must be a number");
    const double v = value_.get<double>();
    if (!(v >= low && v <= high)) fail(fmt::format("{:g} is not in {:g}..{:g}", v, low, high));
    return static_cast<float>(v);
  }
  const std::string& text(std::size_t limit) const {
    if (!value_.is_string()) fail("must be a string");
    const std::string& s = value_.get_ref<const std::string&>();
    if (s.size() > limit) fail(fmt::format("is longer than {} bytes", limit));
    return s;
  }
  template <class Enum>
  Enum choice(std::optional<Enum> (*parse)(const std::string&)) const {
    const std::optional<Enum> value = parse(text(limits::text));
    if (!value) fail("is not a known value");
    return *value;
  }
  std::uint64_t hexadecimal(std::string_view digits) const {
    std::uint64_t value = 0;
    for (const char c : digits) {
      const auto digit = std::string_view("0123456789abcdef").find(c);
      if (digit == std::string_view::npos) fail("must be lower-case hexadecimal digits");
      value = value << 4 | digit;
    }
    return value;
  }
  vec3 vector3(double low, double high) const {
    array(3, 3);
    return {at(0).number(low, high), at(1).number(low, high), at(2).number(low, high)};
  }
  std::vector<vec3> rgb_values(std::size_t count) const {
    array(3 * count, 3 * count);
    std::vector<vec3> values(count);
    for (std::size_t i = 0; i < 3 * count; ++i) {
      const json& v = value_[i];
      const double x = v.is_number() ? v.get<double>() : 0;
      if (!v.is_number() || !(std::abs(x) <= static_cast<double>(limits::coefficient))) {
        at(i).fail(fmt::format("must be a number of magnitude at most {:g}", limits::coefficient));
      }
      values[i / 3][static_cast<int>(i % 3)] = static_cast<float>(x);
    }
    return values;
  }
  sh::RadianceSh function(int degree) const {
    sh::RadianceSh f;
    f.values = rgb_values(static_cast<std::size_t>(sh::coefficient_count(degree)));
    return f;
  }
  bool is_empty_array() const { return value_.is_array() && value_.empty(); }

 private:
  const json& value_;
  const std::string& file_;
  std::string pointer_;
};

GeneratorInfo read_generator(const Place& at) {
  at.object({"operator", "viz", "gen", "max_depth", "passes", "spp", "face_size", "seed", "directions",
             "surfel_size", "link_rays", "scene", "scene_hash", "time"});
  GeneratorInfo g;
  g.op = at["operator"].choice(parse_light_operator);
  g.viz = at["viz"].choice(parse_viz_method);
  g.gen = at["gen"].choice(parse_gen_mode);
  g.max_depth = at["max_depth"].integer(0, limits::depth);
  g.passes = at["passes"].integer(1, limits::samples);
  g.spp = at["spp"].integer(1, limits::samples);
  g.face_size = at["face_size"].integer(1, limits::face_size);
  const std::string& seed = at["seed"].text(16);
  if (seed.empty()) at["seed"].fail("must be 1..16 hexadecimal digits");
  g.seed = at["seed"].hexadecimal(seed);
  g.directions = at["directions"].integer(0, limits::rays);
  g.surfel_size = at["surfel_size"].number(0, limits::coordinate);
  g.link_rays = at["link_rays"].integer(0, limits::rays);
  g.scene = at["scene"].text(limits::text);
  const std::string& hash = at["scene_hash"].text(32);
  if (hash.size() != 32) at["scene_hash"].fail("must be 32 hexadecimal digits");
  g.scene_hash.high = at["scene_hash"].hexadecimal(std::string_view(hash).substr(0, 16));
  g.scene_hash.low = at["scene_hash"].hexadecimal(std::string_view(hash).substr(16));
  g.time = at["time"].number(-limits::coordinate, limits::coordinate);
  return g;
}

Edge read_edge(const Place& at, int degree, std::size_t probe_count) {
  at.object({"from", "transfer", "h"}, {"matrix"});
  Edge edge;
  edge.from = at["from"].integer(0, static_cast<int>(probe_count) - 1);
  edge.transfer = at["transfer"].number(0, 1);
  edge.h = at["h"].function(degree);
  if (at.is_object_with("matrix")) {
    const auto k = static_cast<std::size_t>(sh::coefficient_count(degree));
    edge.matrix.arriving_degree = edge.matrix.emitted_degree = degree;
    edge.matrix.values = at["matrix"].rgb_values(k * k);
  }
  return edge;
}

Probe read_probe(const Place& at, const ProbeSet& set, std::size_t probe_count, bool with_hierarchy) {
  if (with_hierarchy) {
    at.object({"name", "position", "radius", "groups", "edges", "neighbor"});
  } else {
    at.object({"name", "position", "radius", "groups", "edges"});
  }
  Probe probe;
  probe.name = at["name"].text(limits::text);
  probe.position = at["position"].vector3(-limits::coordinate, limits::coordinate);
  probe.radius = at["radius"].number(limits::smallest_radius, limits::coordinate);
  const Place groups = at["groups"];
  groups.array(set.light_groups.size(), set.light_groups.size());
  for (std::size_t g = 0; g < set.light_groups.size(); ++g) {
    const Place group = groups.at(g).object({"emitted", "reflected"});
    GroupLight& light = probe.groups.emplace_back();
    if (!group["emitted"].is_empty_array()) light.emitted = group["emitted"].function(set.degree);
    light.reflected = group["reflected"].function(set.degree);
  }
  const Place edges = at["edges"];
  const std::size_t edge_count = edges.array(0, probe_count - 1);
  for (std::size_t e = 0; e < edge_count; ++e)
    probe.edges.push_back(read_edge(edges.at(e), set.degree, probe_count));
  return probe;
}

FittedPoints read_fitted(const Place& at, std::size_t probe_count) {
  const std::size_t count = at.array(0, limits::fitted_points);
  FittedPoints fitted;
  fitted.points.resize(count);
  fitted.weights.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Place point = at.at(i).object({"position", "normal", "probes", "weights"});
    fitted.points[i] = {point["position"].vector3(-limits::coordinate, limits::coordinate),
                        point["normal"].vector3(-2, 2)};
    const Place probes = point["probes"], weights = point["weights"];
    const std::size_t used = probes.array(0, max_weights);
    weights.array(used, used);
    PointWeights& out = fitted.weights[i];
    for (std::size_t k = 0; k < used; ++k) {
      out.entries[k] = {probes.at(k).integer(0, static_cast<int>(probe_count) - 1),
                        weights.at(k).number(0, limits::fitted_weight)};
    }
    out.count = static_cast<int>(used);
  }
  return fitted;
}

ProbeSet read_set(const Place& root) {
  if (root.is_object_with("version")) root["version"].require_version(probe_file_version);
  root.object({"format", "version", "degree", "generator", "light_groups", "probes"},
              {"hierarchy", "fitted"});
  if (root["format"].text(limits::text) != "ssphh-probes") root["format"].fail("must be \"ssphh-probes\"");
  ProbeSet set;
  set.degree = root["degree"].integer(0, sh::max_degree);
  set.generator = read_generator(root["generator"]);
  const Place groups = root["light_groups"];
  const std::size_t group_count = groups.array(0, limits::light_groups);
  for (std::size_t g = 0; g < group_count; ++g) {
    const Place at = groups.at(g).object({"name", "scale"});
    set.light_groups.push_back({at["name"].text(limits::text), at["scale"].vector3(0, limits::scale)});
  }
  if (root.is_object_with("hierarchy")) {
    const Place at = root["hierarchy"].object({"operator", "neighbors", "threshold"});
    Hierarchy& h = set.hierarchy.emplace();
    h.op = at["operator"].choice(parse_hier_operator);
    h.neighbors = at["neighbors"].integer(-1, static_cast<int>(limits::probes));
    h.threshold = at["threshold"].number(0, 1);
  }
  const Place probes = root["probes"];
  const std::size_t probe_count = probes.array(0, limits::probes);
  for (std::size_t i = 0; i < probe_count; ++i) {
    set.probes.push_back(read_probe(probes.at(i), set, probe_count, set.hierarchy.has_value()));
    if (set.hierarchy) set.hierarchy->neighbor.push_back(probes.at(i)["neighbor"].function(set.degree));
  }
  if (root.is_object_with("fitted")) set.fitted = read_fitted(root["fitted"], probe_count);
  return set;
}

/// Parses with limits on nesting and on containers, which cost far more memory than text.
json parse(std::string_view text, const std::string& where) {
  constexpr int depth_limit = 8;
  constexpr std::size_t container_limit = std::size_t{1} << 21;
  std::size_t containers = 0;
  const auto callback = [&](int depth, json::parse_event_t event, json&) {
    if (event == json::parse_event_t::array_start || event == json::parse_event_t::object_start) {
      if (depth >= depth_limit) throw Error(where, "is nested deeper than any probe file");
      if (++containers > container_limit)
        throw Error(where, "holds more arrays and objects than any probe file");
    }
    return true;
  };
  try {
    return json::parse(text, callback);
  } catch (const json::exception& e) {
    throw Error(where, std::string("is not valid JSON: ") + e.what());
  }
}

}  // namespace

ProbeSet probes_from_json(std::string_view text, const std::string& where) {
  if (text.size() > limits::json_bytes) throw Error(where, "is larger than any JSON probe file may be");
  const json document = parse(text, where);
  ProbeSet set = read_set(Place(document, where, ""));
  finish_reading(set, where);
  return set;
}

}  // namespace ssphh::gi
