#include <optional>

#include <fmt/format.h>

#include <ssphh/core/parallel.h>
#include <ssphh/methods/method_list.h>
#include <ssphh/methods/vct/cone_light.h>
#include <ssphh/rays/posed_world.h>

#include "drawing.h"
#include "gather_points.h"
#include "inject.h"
#include "patch_light.h"

namespace ssphh::methods::vct {
namespace {

using namespace vct;

/// Of all poses, by looking at some.
scene::Bounds bounds_of_all_poses(const rays::TransportSource& source) {
  constexpr int looks = 33;
  scene::Bounds all;
  const float duration = source.duration();
  const int count = duration > 0 ? looks : 1;
  for (int i = 0; i < count; ++i) {
    const float time = count > 1 ? duration * static_cast<float>(i) / static_cast<float>(count - 1) : 0;
    const scene::Bounds bounds = rays::PosedWorld(source, time).bounds();
    if (!bounds.empty()) all.add(bounds.min), all.add(bounds.max);
  }
  return all;
}

struct VctParams {
  int resolution = 128;
  Storage storage = Storage::sparse;
  int bounces = 6;
  int samples = 4;
  ConeParams cones;
  int bounce_cones = 10;
};

/// Voxel cone tracing (Crassin, Neyret, Sainz, Green & Eisemann, Interactive Indirect Illumination Using
/// Voxel Cone Tracing, Computer Graphics Forum 30(7), 2011).
class Vct final : public Method {
 public:
  Vct(const MethodScene& scene, const VctParams& params, const Control& control)
      : scene_(scene),
        params_(params),
        grid_(make_grid(bounds_of_all_poses(scene.source), params.resolution)) {
    const rays::PosedWorld surfaces(scene.source, 0);
    still_.set = make_patches(voxelize(scene.scene, 0, false, grid_, control), surfaces, grid_,
                              {params.samples, false}, control);
    still_.light.reset(still_.set.patches.size(), scene.source.light_groups().size());
    still_.irradiance.resize(still_.set.patches.size());
  }

  void update(const scene::LightingState& state, const Control& control) override {
    const std::vector<mat4> poses = part_poses(scene_.source, state.time);
    const bool first = poses_.empty();
    const bool moved = first || poses != poses_;
    std::vector<scene::Bounds> boxes;
    if (moved) {
      boxes = boxes_of_moved(poses);
      place(state.time, control);
    }
    if (moved || state.lights != lights_ || state.environment() != environment_)
      relight(state, poses, first ? nullptr : &boxes, moved);
    poses_ = poses, lights_ = state.lights, environment_ = state.environment();

    still_.light.sum(state.group_scales, still_.irradiance);
    moving_.light.sum(state.group_scales, moving_.irradiance);
    fill(still_.irradiance, moving_.irradiance);
    bounce(control);
  }

  const rays::IndirectLight& light() const override { return *light_; }
  LightData light_data() const override { return VoxelCones{&*pyramid_, params_.cones}; }

  sketch::Sketch drawing(Drawing what) const override {
    if (what != Drawing::voxels) return {};
    std::vector<VoxelKey> keys;
    for (const VoxelPatches& voxel : voxels_) keys.push_back(voxel.voxel);
    return voxels_drawing(*pyramid_, keys);
  }

  MethodMemory memory() const override {
    return {pyramid_->bytes(),
            still_.bytes() + moving_.bytes() + voxels_.size() * sizeof(VoxelPatches) +
                gather_.points.size() * sizeof(rays::SurfacePoint) +
                (gather_.of_still.size() + gather_.of_moving.size()) * sizeof(std::uint32_t)};
  }

  MethodNumbers numbers() const override {
    return {{"voxel_size", static_cast<double>(grid_.voxel)},
            {"levels", pyramid_->levels()},
            {"bricks", static_cast<double>(pyramid_->bricks(0))},
            {"voxels", static_cast<double>(voxels_.size())},
            {"patches", static_cast<double>(still_.set.patches.size() + moving_.set.patches.size())},
            {"gather_points", static_cast<double>(gather_.points.size())},
            {"points_relit", static_cast<double>(points_relit_)}};
  }

 private:
  struct Lit {
    PatchSet set;
    PatchLight light;
    std::vector<vec3> irradiance;

    std::size_t bytes() const {
      return set.patches.size() * (sizeof(Patch) + sizeof(vec3)) +
             set.samples.size() * sizeof(rays::SurfacePoint) + light.bytes();
    }
  };

  /// World bounds of the parts that moved, before and after.
  std::vector<scene::Bounds> boxes_of_moved(const std::vector<mat4>& poses) const {
    std::vector<scene::Bounds> boxes;
    for (std::size_t p = 0; p < poses.size(); ++p) {
      const scene::Bounds local = scene_.source.part_bounds(static_cast<int>(p));
      if (local.empty() || poses_.empty() || poses[p] == poses_[p]) continue;
      boxes.push_back(rays::transformed(local, poses_[p]));
      boxes.push_back(rays::transformed(local, poses[p]));
    }
    return boxes;
  }

  /// Cuts what moves anew, and rebuilds the tree.
  void place(float time, const Control& control) {
    const rays::PosedWorld surfaces(scene_.source, time);
    moving_.set = make_patches(voxelize(scene_.scene, time, true, grid_, control), surfaces, grid_,
                               {params_.samples, true}, control);
    moving_.light.reset(moving_.set.patches.size(), scene_.source.light_groups().size());
    moving_.irradiance.resize(moving_.set.patches.size());
    voxels_ = by_voxel(still_.set.patches, moving_.set.patches);
    gather_ = gather_points(still_.set.patches, moving_.set.patches);
    std::vector<VoxelKey> occupied;
    for (const VoxelPatches& voxel : voxels_) occupied.push_back(voxel.voxel);
    light_.reset();
    pyramid_.reset();  // first: the two would not always fit side by side
    pyramid_.emplace(grid_, params_.storage, occupied);
    light_.emplace(*pyramid_, params_.cones);
  }

  /// Asks for direct light where lamps or shadows changed; `boxes` null: everywhere.
  void relight(const scene::LightingState& state, const std::vector<mat4>& poses,
               const std::vector<scene::Bounds>* boxes, bool moved) {
    const auto direct = scene_.source.direct_light(state.lights, poses, state.environment());
    points_relit_ = 0;
    for (int g = 0; g < static_cast<int>(state.group_scales.size()); ++g) {
      if (!boxes || group_changed(g, state, poses)) {
        points_relit_ += still_.light.update(g, still_.set, *direct);
        points_relit_ += moving_.light.update(g, moving_.set, *direct);
      } else if (moved) {
        points_relit_ += still_.light.update(g, still_.set, *direct, boxes);
        points_relit_ += moving_.light.update(g, moving_.set, *direct);
      }
    }
  }

  /// Whether emitters of the group changed or went elsewhere.
  bool group_changed(int group, const scene::LightingState& state, const std::vector<mat4>& poses) const {
    if (group == scene_.source.environment_group() && state.environment() != environment_) return true;
    for (std::size_t i = 0; i < state.lights.size(); ++i) {
      if (scene_.source.light_group_of(static_cast<int>(i)) == group && !(state.lights[i] == lights_[i]))
        return true;
    }
    for (std::size_t p = 1; p < poses.size(); ++p) {
      if (poses[p] != poses_[p] && scene_.source.group_emits_from(group, static_cast<int>(p))) return true;
    }
    return false;
  }

  void fill(std::span<const vec3> still, std::span<const vec3> moving) {
    inject(voxels_, {still_.set.patches, still}, {moving_.set.patches, moving}, *pyramid_);
    pyramid_->filter();
  }

  /// Gathers at the patches what the voxels show and shows that, too.
  void bounce(const Control& control) {
    ConeParams cones = params_.cones;
    cones.cones = params_.bounce_cones;
    const ConeLight gather(*pyramid_, cones);
    std::vector<vec3> gathered(gather_.points.size());
    const auto add = [&](const Lit& lit, const std::vector<std::uint32_t>& point, std::vector<vec3>& sum) {
      sum.resize(lit.irradiance.size());
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = lit.irradiance[i] + gathered[point[i]];
    };
    std::vector<vec3> still, moving;
    for (int b = 1; b < params_.bounces; ++b) {
      parallel_for(
          gathered.size(), 32, [&](std::size_t i) { gathered[i] = gather.irradiance(gather_.points[i]); },
          control);
      add(still_, gather_.of_still, still), add(moving_, gather_.of_moving, moving);
      fill(still, moving);
    }
  }

  MethodScene scene_;
  VctParams params_;
  VoxelGrid grid_;
  Lit still_, moving_;
  std::vector<VoxelPatches> voxels_;
  GatherPoints gather_;
  std::optional<Pyramid> pyramid_;
  std::optional<ConeLight> light_;
  std::vector<mat4> poses_;  ///< of the last update; empty: none yet
  std::vector<scene::LightState> lights_;
  scene::EnvironmentState environment_;
  std::size_t points_relit_ = 0;
};

VctParams vct_params(const MethodParameters& p) {
  VctParams params;
  params.resolution = std::stoi(p.choice("resolution"));
  params.storage = p.choice<Storage>("storage");
  params.bounces = p.integer("bounces");
  params.samples = p.integer("samples");
  params.cones.opacity = static_cast<float>(p.number("opacity"));
  params.cones.cones = p.integer("cones");
  params.cones.offset = static_cast<float>(p.number("offset"));
  params.cones.step = static_cast<float>(p.number("step"));
  params.bounce_cones = p.integer("bounce_cones");
  return params;
}

}  // namespace

MethodEntry entry() {
  return {"vct",
          "voxel cone tracing: direct light on voxels, gathered by cones",
          {word_parameter("resolution", {"8", "16", "32", "64", "128", "256", "512"},
                          "voxels along the scene's longest edge", 4),
           choice_parameter("storage", Storage::sparse, "of the voxels: octree of bricks, or whole arrays"),
           {"bounces", 6, 1, 32, "of indirect light; 1: what directly lit surfaces scatter", true},
           {"cones", 16, 3, 4096, "over the hemisphere of a point that is lit", true},
           {"bounce_cones", 10, 3, 4096, "over the hemisphere of a voxel, from the second bounce on", true},
           {"offset", 1, 0, 16, "of a cone's start from the surface, in voxels"},
           {"step", 0.5, 0.05, 1, "of a cone, in voxels of the level that it reads"},
           {"opacity", 1, 1, 8, "multiplies what voxels cover"},
           {"samples", 4, 1, 16, "points of a voxel's side at which lamps are asked for", true}},
          [](const MethodScene& scene, const MethodParameters& p, const Control& control)
              -> std::unique_ptr<Method> { return std::make_unique<Vct>(scene, vct_params(p), control); },
          true,
          {Drawing::voxels}};
}

}  // namespace ssphh::methods::vct
