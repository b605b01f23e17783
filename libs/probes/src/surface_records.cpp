#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/core/math.h>
#include <ssphh/core/require.h>
#include <ssphh/probes/surface_records.h>

namespace ssphh::probes {
namespace {

constexpr float steps = 32767;

bool same_place(const rays::SurfacePoint& a, const rays::SurfacePoint& b) {
  return a.position == b.position && a.normal == b.normal;
}

}  // namespace

PackedRecordLight pack(const RecordLight& light, const vec3& normal) {
  const Frame frame = Frame::around(normal);
  const std::array<vec3, 3> kept = {light[3], light * vec4(frame.x, 0), light * vec4(frame.y, 0)};
  PackedRecordLight out;
  for (const vec3& v : kept) out.scale = std::max(out.scale, max_component(glm::abs(v)));
  if (!(out.scale > 0)) return {};
  for (std::size_t k = 0; k < 9; ++k) {
    const float share = kept[k / 3][static_cast<glm::length_t>(k % 3)] / out.scale;
    out.values[k] = static_cast<std::int16_t>(std::lround(steps * share));
  }
  return out;
}

RecordLight unpack(const PackedRecordLight& packed, const vec3& normal) {
  const auto kept = [&](std::size_t k) {
    const auto number = [&](std::size_t c) { return static_cast<float>(packed.values[3 * k + c]); };
    return packed.scale / steps * vec3(number(0), number(1), number(2));
  };
  const Frame frame = Frame::around(normal);
  RecordLight light(0);
  for (glm::length_t c = 0; c < 3; ++c) light[c] = frame.x[c] * kept(1) + frame.y[c] * kept(2);
  light[3] = kept(0);
  return light;
}

bool operator==(const SurfaceRecords& a, const SurfaceRecords& b) {
  return std::ranges::equal(a.points, b.points, same_place) && a.groups == b.groups && a.direct == b.direct &&
         a.light == b.light;
}

void require_whole(const SurfaceRecords& records, std::size_t group_count) {
  require(records.groups.size() == group_count, "surface records", "not every light group has its light");
  for (std::size_t i = 0; i < records.points.size(); ++i) {
    if (!is_finite(records.points[i].position) || !is_finite(records.points[i].normal))
      throw Error(fmt::format("surface record {}", i), "its place is not finite");
  }
  require(records.direct.size() <= group_count, "surface records", "there is direct light of no group");
  const auto require_light = [&](const std::vector<PackedRecordLight>& group) {
    require(group.size() == records.points.size(), "surface records", "not every point has its light");
    for (std::size_t i = 0; i < group.size(); ++i) {
      if (!(group[i].scale >= 0) || !std::isfinite(group[i].scale))
        throw Error(fmt::format("surface record {}", i), "its light is not finite");
    }
  };
  std::ranges::for_each(records.groups, require_light);
  for (const std::vector<PackedRecordLight>& group : records.direct)
    if (!group.empty()) require_light(group);
}

void merge_groups(SurfaceRecords& records, std::span<const vec3> scales,
                  const std::vector<bool>& with_direct) {
  require_whole(records, scales.size());
  records.light.assign(records.points.size(), RecordLight(0));
  const auto add = [&](const std::vector<PackedRecordLight>& group, const vec3& scale) {
    for (std::size_t i = 0; i < records.points.size(); ++i) {
      const RecordLight light = unpack(group[i], records.points[i].normal);
      for (glm::length_t c = 0; c < 4; ++c) records.light[i][c] += scale * light[c];
    }
  };
  for (std::size_t g = 0; g < scales.size(); ++g) {
    add(records.groups[g], scales[g]);
    if (g < with_direct.size() && with_direct[g] && records.keeps_direct(g))
      add(records.direct[g], scales[g]);
  }
}

}  // namespace ssphh::probes
