#include <algorithm>
#include <cmath>

#include <ssphh/core/require.h>
#include <ssphh/rays/posed_world.h>

namespace ssphh::rays {

scene::Bounds transformed(const scene::Bounds& box, const mat4& matrix) {
  scene::Bounds out;
  if (box.empty()) return out;
  for (const float x : {box.min.x, box.max.x}) {
    for (const float y : {box.min.y, box.max.y}) {
      for (const float z : {box.min.z, box.max.z}) out.add(vec3(matrix * vec4(x, y, z, 1)));
    }
  }
  return out;
}

PosedWorld::PosedWorld(const TransportSource& source, float time)
    : source_(source), bounds_(source.part_bounds(0)) {
  for (int part = 1; part < source.part_count(); ++part) place(part, source.part_pose(part, time));
}

PosedWorld::PosedWorld(const TransportSource& source, std::span<const mat4> poses)
    : source_(source), bounds_(source.part_bounds(0)) {
  require(static_cast<int>(poses.size()) == source.part_count(), "posed world",
          "there is not one pose for each part");
  for (int part = 1; part < source.part_count(); ++part) place(part, poses[part]);
}

void PosedWorld::place(int part, const mat4& pose) {
  const scene::Bounds box = transformed(source_.part_bounds(part), pose);
  const float det = glm::determinant(mat3(pose));
  if (box.empty() || !std::isfinite(1 / det)) return;
  moving_.push_back({part, glm::inverse(pose)});
  bounds_.add(box.min), bounds_.add(box.max);
}

template <class Visit>
void PosedWorld::for_parts(std::span<const RayQuery> rays, const Visit& visit) const {
  visit(Part{0, glm::inverse(mat4(1))}, rays);
  if (moving_.empty()) return;
  std::vector<RayQuery> local(rays.size());
  for (const Part& part : moving_) {
    std::ranges::transform(rays, local.begin(), [&](const RayQuery& ray) { return part.in_frame(ray); });
    visit(part, std::span<const RayQuery>(local));
  }
}

void PosedWorld::intersect(std::span<const RayQuery> rays, std::span<RayHit> hits,
                           std::span<std::uint8_t> moves) const {
  std::ranges::fill(moves, std::uint8_t{0});
  std::vector<RayHit> found;
  for_parts(rays, [&](const Part& part, std::span<const RayQuery> local) {
    // All parts alike: a zero's sign decides the frame around a normal.
    const mat3 normals = glm::transpose(mat3(part.to_part));
    if (part.index == 0) {
      source_.intersect(0, local, hits);
      for (RayHit& hit : hits) {
        if (!hit.escaped()) hit.normal = glm::normalize(normals * hit.normal);
      }
      return;
    }
    found.resize(rays.size());
    source_.intersect(part.index, local, found);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (!(found[i].distance < hits[i].distance)) continue;
      hits[i] = found[i];
      hits[i].normal = glm::normalize(normals * found[i].normal);
      if (!moves.empty()) moves[i] = 1;
    }
  });
}

void PosedWorld::occluded(std::span<const RayQuery> segments, std::span<std::uint8_t> blocked) const {
  std::vector<std::uint8_t> met;
  for_parts(segments, [&](const Part& part, std::span<const RayQuery> local) {
    if (part.index == 0) return source_.occluded(0, local, blocked);
    met.resize(segments.size());
    source_.occluded(part.index, local, met);
    for (std::size_t i = 0; i < segments.size(); ++i) blocked[i] |= met[i];
  });
}

bool PosedWorld::joined(const vec3& a, const vec3& b) const {
  const RayQuery way{a, b - a, 1};
  return source_.joined(0, way) && std::ranges::all_of(moving_, [&](const Part& part) {
           return source_.joined(part.index, part.in_frame(way));
         });
}

bool PosedWorld::occluded(const RayQuery& segment) const {
  const auto blocks = [&](int part, const RayQuery& local) {
    std::uint8_t blocked = 0;
    source_.occluded(part, {&local, 1}, {&blocked, 1});
    return blocked != 0;
  };
  return blocks(0, segment) || std::ranges::any_of(moving_, [&](const Part& part) {
           return blocks(part.index, part.in_frame(segment));
         });
}

}  // namespace ssphh::rays
