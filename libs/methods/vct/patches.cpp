#include "patches.h"

#include <algorithm>
#include <cmath>

#include <ssphh/core/random.h>
#include <ssphh/core/sphere.h>

#include "gather_points.h"

namespace ssphh::methods::vct {
namespace {

constexpr std::size_t ray_batch = 1 << 15;
constexpr int back_rays = 16, back_least = back_rays / 4;

/// Front side only, before rays were asked.
struct Draft {
  Patch patch;
  vec3 area{0}, moment{0};
  float size = 0, largest = 0;
  vec3 on_surface{0}, its_normal{0};  ///< of the largest fragment
  bool cutout = false;
  int side = 0;  ///< main side of its fragments

  void add(const Fragment& fragment, const VoxelGrid& grid) {
    const float piece = glm::length(fragment.area);
    for (int axis = 0; axis < 3; ++axis) {
      const float a = fragment.area[axis];
      patch.cover[2 * axis + (a < 0 ? 1 : 0)] += std::abs(a);
    }
    const vec3 centroid = grid.to_world(fragment.centroid);
    area += fragment.area, moment += piece * centroid, size += piece;
    cutout |= fragment.cutout;
    if (piece > largest) largest = piece, on_surface = centroid, its_normal = fragment.area / piece;
  }
};

/// The draft that a fragment continues: it faces the same way and lies in the same plane, more or less. A
/// panel before a wall must not be mixed with what it hides.
Draft& draft_for(const Fragment& fragment, const VoxelGrid& grid, std::vector<Draft>& drafts) {
  constexpr float thickness = 0.15f;  // voxels
  constexpr std::size_t most = 24;
  const int side = main_side(fragment.area);
  const vec3 centroid = grid.to_world(fragment.centroid), normal = glm::normalize(fragment.area);
  Draft* nearest = nullptr;
  float least = std::numeric_limits<float>::infinity();
  for (Draft& draft : drafts) {
    if (draft.side != side) continue;
    const vec3 way = centroid - draft.on_surface;
    const float apart = std::max(std::abs(glm::dot(way, draft.its_normal)), std::abs(glm::dot(way, normal)));
    if (apart < least) least = apart, nearest = &draft;
  }
  if (nearest && (least < thickness * grid.voxel || drafts.size() >= most)) return *nearest;
  drafts.emplace_back().side = side;
  return drafts.back();
}

std::vector<Draft> join(std::span<const Fragment> fragments, const VoxelGrid& grid) {
  std::vector<Draft> drafts;
  std::vector<Draft> here;
  for (std::size_t begin = 0; begin < fragments.size();) {
    here.clear();
    std::size_t end = begin;
    for (; end < fragments.size() && fragments[end].voxel == fragments[begin].voxel; ++end)
      draft_for(fragments[end], grid, here).add(fragments[end], grid);
    for (Draft& draft : here) {
      draft.patch.voxel = fragments[begin].voxel;
      draft.patch.position = draft.moment / draft.size;
      draft.patch.normal = glm::normalize(draft.area);
      drafts.push_back(draft);
    }
    begin = end;
  }
  return drafts;
}

/// Toward the surface: sample 0 at a place known to be on it, the others about the patch's middle.
rays::RayQuery sample_ray(const Draft& draft, int sample, int count, std::uint64_t seed, float voxel) {
  const Frame frame = Frame::around(draft.its_normal);
  if (sample == 0) {
    // Along a random direction, so that the albedo is one averaged over directions.
    const float lift = 1e-3f * voxel;
    const vec3 d = frame.to_world(sample_cosine_hemisphere(SampleSequence(seed, 0).next2()));
    return {draft.on_surface + lift * d, -d, 2 * lift};
  }
  const Frame tangent = Frame::around(draft.patch.normal);
  const float turn = static_cast<float>(sample) / static_cast<float>(count - 1);
  const vec2 way = 0.3f * voxel * unit_circle(turn);
  return {draft.patch.position + way.x * tangent.x + way.y * tangent.y + 0.25f * voxel * tangent.z,
          -tangent.z, 0.5f * voxel};
}

struct Sampled {
  vec3 albedo{0};
  std::vector<rays::SurfacePoint> points;
};

/// Samples of drafts [begin, end) by one batch of rays.
std::vector<Sampled> sample(std::span<const Draft> drafts, const rays::PosedWorld& surfaces, float voxel,
                            const PatchParams& params) {
  const auto count = static_cast<std::size_t>(params.samples);
  std::vector<rays::RayQuery> rays;
  for (const Draft& draft : drafts) {
    for (int s = 0; s < params.samples; ++s)
      rays.push_back(sample_ray(draft, s, params.samples, mix64(draft.patch.voxel), voxel));
  }
  std::vector<rays::RayHit> hits(rays.size());
  surfaces.intersect(rays, hits);
  std::vector<Sampled> result(drafts.size());
  for (std::size_t i = 0; i < drafts.size(); ++i) {
    const vec3& normal = drafts[i].patch.normal;
    for (std::size_t r = i * count; r < (i + 1) * count; ++r) {
      if (hits[r].escaped() || glm::dot(hits[r].normal, normal) < 0.5f) continue;
      result[i].albedo += hits[r].albedo;
      result[i].points.push_back(
          {rays[r].origin + hits[r].distance * rays[r].direction, hits[r].normal, params.moving});
    }
    // A sliver that no ray met, but of which it is known that it is there.
    if (result[i].points.empty() && !drafts[i].cutout)
      result[i].points.push_back({drafts[i].on_surface, drafts[i].its_normal, params.moving});
    if (!result[i].points.empty()) result[i].albedo /= static_cast<float>(result[i].points.size());
  }
  return result;
}

/// seen[i] = 1 where rays from behind draft i meet fronts.
std::vector<std::uint8_t> seen_from_behind(std::span<const Draft> drafts, const rays::PosedWorld& surfaces,
                                           float voxel) {
  std::vector<rays::RayQuery> rays;
  for (const Draft& draft : drafts) {
    const Frame frame = Frame::around(-draft.its_normal);
    for (int r = 0; r < back_rays; ++r) {
      const vec2 u = SampleSequence(mix64(draft.patch.voxel), static_cast<std::uint32_t>(r)).next2();
      rays.push_back(
          {draft.on_surface + 1e-3f * voxel * frame.z, frame.to_world(sample_cosine_hemisphere(u))});
    }
  }
  std::vector<rays::RayHit> hits(rays.size());
  surfaces.intersect(rays, hits);
  std::vector<std::uint8_t> seen(drafts.size());
  for (std::size_t i = 0; i < drafts.size(); ++i) {
    int fronts = 0;
    for (std::size_t r = i * back_rays; r < (i + 1) * back_rays; ++r)
      fronts += !hits[r].escaped() && !hits[r].back ? 1 : 0;
    seen[i] = fronts >= back_least ? 1 : 0;
  }
  return seen;
}

void add_patch(PatchSet& set, Patch patch, const Sampled& sampled, float turn) {
  patch.first_sample = static_cast<std::uint32_t>(set.samples.size());
  patch.samples = static_cast<std::uint32_t>(sampled.points.size());
  patch.albedo = sampled.albedo;
  for (rays::SurfacePoint point : sampled.points) {
    point.normal *= turn;
    set.samples.push_back(point);
  }
  set.patches.push_back(patch);
}

Patch turned(Patch patch) {
  for (std::size_t side = 0; side < side_count; side += 2)
    std::swap(patch.cover[side], patch.cover[side + 1]);
  patch.normal = -patch.normal;
  return patch;
}

}  // namespace

PatchSet make_patches(std::span<const Fragment> fragments, const rays::PosedWorld& surfaces,
                      const VoxelGrid& grid, const PatchParams& params, const Control& control) {
  const std::vector<Draft> drafts = join(fragments, grid);
  PatchSet set;
  ProgressStage progress(control, "voxels", drafts.size(), "patches");
  for (std::size_t begin = 0; begin < drafts.size(); begin += ray_batch) {
    control.check();
    const std::span<const Draft> batch =
        std::span(drafts).subspan(begin, std::min(ray_batch, drafts.size() - begin));
    const std::vector<Sampled> sampled = sample(batch, surfaces, grid.voxel, params);
    const std::vector<std::uint8_t> behind = seen_from_behind(batch, surfaces, grid.voxel);
    for (std::size_t i = 0; i < batch.size(); ++i) {
      Patch patch = batch[i].patch;
      if (batch[i].cutout) {
        const float share = static_cast<float>(sampled[i].points.size()) / static_cast<float>(params.samples);
        for (float& cover : patch.cover) cover *= share;
      }
      if (sampled[i].points.empty()) continue;
      add_patch(set, patch, sampled[i], 1);
      if (behind[i]) add_patch(set, turned(patch), sampled[i], -1);
    }
    progress.advance(batch.size());
  }
  return set;
}

}  // namespace ssphh::methods::vct
