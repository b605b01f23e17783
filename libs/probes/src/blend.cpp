#include <algorithm>
#include <climits>
#include <iterator>

#include <fmt/format.h>

#include <ssphh/core/math.h>
#include <ssphh/core/require.h>
#include <ssphh/probes/blend.h>

namespace ssphh::probes {
namespace {

constexpr float place_tolerance = 1e-4f;  // metres: files of text round

/// Whether direct light can be found by who draws.
bool by_renderer(scene::LightMode mode) {
  return mode == scene::LightMode::realtime || mode == scene::LightMode::diffuse;
}

/// Throws Error for sets that are not of one network.
void require_one_network(const ProbeSet& a, const ProbeSet& b) {
  const auto differ = [](const std::string& what) {
    throw Error("probe sets", "cannot be blended: " + what,
                "bake them with the same places, degree and light groups");
  };
  if (a.degree != b.degree) differ(fmt::format("degree {} and {}", a.degree, b.degree));
  if (a.probes.size() != b.probes.size())
    differ(fmt::format("{} and {} probes", a.probes.size(), b.probes.size()));
  for (std::size_t i = 0; i < a.probes.size(); ++i) {
    const vec3 &p = a.probes[i].position, &q = b.probes[i].position;
    if (!(glm::distance(p, q) <= place_tolerance))
      differ(fmt::format("probe \"{}\" stands at ({:.4g}, {:.4g}, {:.4g}) and ({:.4g}, {:.4g}, {:.4g}) m",
                         a.probes[i].name, p.x, p.y, p.z, q.x, q.y, q.z));
  }
  if (a.light_groups.size() != b.light_groups.size())
    differ(fmt::format("{} and {} light groups", a.light_groups.size(), b.light_groups.size()));
  for (std::size_t g = 0; g < a.light_groups.size(); ++g) {
    const LightGroup &one = a.light_groups[g], &other = b.light_groups[g];
    if (one.name != other.name) differ(fmt::format("light group \"{}\" and \"{}\"", one.name, other.name));
    if (one.mode != other.mode && !(by_renderer(one.mode) && by_renderer(other.mode)))
      differ(
          fmt::format("light group \"{}\" is {} and {}", one.name, name_of(one.mode), name_of(other.mode)));
  }
}

/// What the light of a group is multiplied by, in each of the sets.
struct GroupShares {
  vec3 a, b;
};

/// Empty stands for darkness.
sh::RadianceSh mix(const sh::RadianceSh& a, const sh::RadianceSh& b, const GroupShares& shares) {
  if (a.empty() && b.empty()) return {};
  sh::RadianceSh sum;
  sum.values.assign(std::max(a.values.size(), b.values.size()), vec3(0));
  for (std::size_t k = 0; k < a.values.size(); ++k) sum.values[k] += shares.a * a.values[k];
  for (std::size_t k = 0; k < b.values.size(); ++k) sum.values[k] += shares.b * b.values[k];
  return sum;
}

std::vector<GroupLight> mix(const std::vector<GroupLight>& a, const std::vector<GroupLight>& b,
                            const std::vector<GroupShares>& shares) {
  std::vector<GroupLight> mixed(std::max(a.size(), b.size()));
  const GroupLight dark;
  for (std::size_t g = 0; g < mixed.size(); ++g) {
    const GroupLight &one = g < a.size() ? a[g] : dark, &other = g < b.size() ? b[g] : dark;
    mixed[g] = {mix(one.emitted, other.emitted, shares[g]), mix(one.reflected, other.reflected, shares[g])};
  }
  return mixed;
}

sh::TransferMatrix mix(const sh::TransferMatrix& a, const sh::TransferMatrix& b, float t) {
  sh::TransferMatrix sum = a.values.empty() ? b : a;
  for (std::size_t k = 0; k < sum.values.size(); ++k) {
    const vec3 from = a.values.empty() ? vec3(0) : a.values[k], to = b.values.empty() ? vec3(0) : b.values[k];
    sum.values[k] = (1 - t) * from + t * to;
  }
  return sum;
}

std::vector<Edge> mix(const std::vector<Edge>& a, const std::vector<Edge>& b, float t) {
  std::vector<Edge> mixed;
  const GroupShares shares{vec3(1 - t), vec3(t)};
  for (auto i = a.begin(), j = b.begin(); i != a.end() || j != b.end();) {
    const int from = std::min(i != a.end() ? i->from : INT_MAX, j != b.end() ? j->from : INT_MAX);
    const Edge dark;
    const Edge& one = i != a.end() && i->from == from ? *i++ : dark;
    const Edge& other = j != b.end() && j->from == from ? *j++ : dark;
    Edge edge{from, (1 - t) * one.transfer + t * other.transfer, mix(one.h, other.h, shares),
              mix(one.matrix, other.matrix, t)};
    if (edge.transfer > 0) mixed.push_back(std::move(edge));
  }
  return mixed;
}

bool same_points(const SurfaceRecords& a, const SurfaceRecords& b) {
  return std::ranges::equal(a.points, b.points, [](const rays::SurfacePoint& p, const rays::SurfacePoint& q) {
    return glm::distance(p.position, q.position) <= place_tolerance && glm::dot(p.normal, q.normal) > 0.999f;
  });
}

/// Records of one group; empty stands for darkness.
std::vector<PackedRecordLight> mix(std::span<const PackedRecordLight> a, std::span<const PackedRecordLight> b,
                                   const std::vector<rays::SurfacePoint>& points, const GroupShares& shares) {
  if (a.empty() && b.empty()) return {};
  std::vector<PackedRecordLight> mixed(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    RecordLight light(0), other(0);
    const vec3& normal = points[i].normal;
    if (!a.empty()) light = unpack(a[i], normal);
    if (!b.empty()) other = unpack(b[i], normal);
    for (int c = 0; c < 4; ++c) light[c] = shares.a * light[c] + shares.b * other[c];
    mixed[i] = pack(light, normal);
  }
  return mixed;
}

SurfaceRecords mix(const SurfaceRecords& a, const SurfaceRecords& b, const std::vector<GroupShares>& shares) {
  SurfaceRecords mixed;
  mixed.points = a.points;
  const auto group = [](const std::vector<std::vector<PackedRecordLight>>& all, std::size_t g) {
    return g < all.size() ? std::span<const PackedRecordLight>(all[g]) : std::span<const PackedRecordLight>();
  };
  for (std::size_t g = 0; g < a.groups.size(); ++g)
    mixed.groups.push_back(mix(group(a.groups, g), group(b.groups, g), mixed.points, shares[g]));
  for (std::size_t g = 0; g < std::max(a.direct.size(), b.direct.size()); ++g)
    mixed.direct.push_back(mix(group(a.direct, g), group(b.direct, g), mixed.points, shares[g]));
  return mixed;
}

}  // namespace

BlendedSet blend(const ProbeSet& a, const ProbeSet& b, float t) {
  require(t >= 0 && t <= 1, "blend", "t must be from 0 to 1");
  require_one_network(a, b);
  if (t == 0 || t == 1) return {t == 0 ? a : b, {}};
  const ProbeSet& nearer = t < 0.5f ? a : b;
  BlendedSet blended;
  ProbeSet& set = blended.set;
  set.degree = a.degree, set.generator = nearer.generator, set.light_groups = a.light_groups;
  set.generator.time = (1 - t) * a.generator.time + t * b.generator.time;
  if (a.generator.scene_hash != b.generator.scene_hash) set.generator.scene_hash = {};

  std::vector<GroupShares> shares;
  for (std::size_t g = 0; g < a.light_groups.size(); ++g) {
    const vec3 &one = a.light_groups[g].scale, &other = b.light_groups[g].scale;
    const bool alike = one == other;
    if (!alike) set.light_groups[g].scale = vec3(1);
    if (a.light_groups[g].mode != b.light_groups[g].mode)
      set.light_groups[g].mode = scene::LightMode::realtime;
    shares.push_back({(1 - t) * (alike ? vec3(1) : one), t * (alike ? vec3(1) : other)});
  }
  for (std::size_t i = 0; i < a.probes.size(); ++i) {
    Probe& probe = set.probes.emplace_back();
    probe.name = a.probes[i].name, probe.position = a.probes[i].position, probe.radius = a.probes[i].radius;
    probe.groups = mix(a.probes[i].groups, b.probes[i].groups, shares);
    probe.edges = mix(a.probes[i].edges, b.probes[i].edges, t);
  }
  const auto leave_out = [&](bool there, const char* what) {
    if (there) blended.left_out.emplace_back(what);
  };
  if (a.surface && b.surface && same_points(*a.surface, *b.surface)) {
    set.surface = mix(*a.surface, *b.surface, shares);
  } else {
    leave_out(a.surface || b.surface, "surface records");
  }
  if (a.fitted == b.fitted) set.fitted = a.fitted;
  leave_out(a.fitted != b.fitted, "fitted weights");
  leave_out(a.hierarchy || b.hierarchy, "the hierarchy");
  merge_groups(set);
  return blended;
}

BlendedSet light_at(const std::vector<KeyedSet>& keys, float time) {
  require(!keys.empty(), "keyed light", "there is no key");
  for (std::size_t k = 1; k < keys.size(); ++k)
    require(keys[k - 1].time < keys[k].time, "keyed light", "its keys do not follow each other in time");
  const auto after = std::ranges::find_if(keys, [&](const KeyedSet& key) { return !(key.time <= time); });
  if (after == keys.begin()) return {keys.front().set, {}};
  if (after == keys.end()) return {keys.back().set, {}};
  const KeyedSet& before = *std::prev(after);
  return blend(before.set, after->set, (time - before.time) / (after->time - before.time));
}

}  // namespace ssphh::probes
