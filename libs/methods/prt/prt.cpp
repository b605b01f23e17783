#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/core/parallel.h>
#include <ssphh/methods/method_list.h>
#include <ssphh/probes/lookup.h>
#include <ssphh/scene/probe_place.h>
#include <ssphh/sh/rotate.h>
#include <ssphh/transport/session_sets.h>

#include "drawing.h"
#include "probe_volume/probe_volume.h"
#include "sky_transfer.h"

namespace ssphh::methods::prt {
namespace {

/// How light of the environment reaches surfaces.
enum class EnvironmentLight { transfer, probes };
constexpr auto enum_table(EnvironmentLight) {
  using enum EnvironmentLight;
  return std::to_array<EnumName<EnvironmentLight>>({{transfer, "transfer"}, {probes, "probes"}});
}

constexpr int moving_degree = 2;  ///< of irradiance where there are no transfer vectors
/// Of the scene's radius: how far surface points may lie off the mesh, and the longest edge.
constexpr float mesh_reach = 2e-3f, usual_edge = 1.0f / 14;
/// Of the scene's radius: between vertices whose transfer vectors are drawn; of that, a lobe's value of 1.
constexpr float shown_share = 1.0f / 6, lobe_share = 0.3f;

/// Irradiance kept at vertices; between probes for what moves, and for glossy lobes.
class VertexLight final : public rays::IndirectLight {
 public:
  std::vector<uvec3> triangles;
  MeshIndex index;
  std::vector<vec3> irradiance_of;  ///< each vertex
  std::optional<probes::IrradianceLookup> between_probes;

  vec3 irradiance(const rays::SurfacePoint& at) const override {
    const MeshPlace place = index.find(at);
    if (place.triangle < 0) return between_probes->irradiance(at);
    const uvec3& t = triangles[place.triangle];
    return place.weight.x * irradiance_of[t.x] + place.weight.y * irradiance_of[t.y] +
           place.weight.z * irradiance_of[t.z];
  }
  vec3 glossy(const rays::SurfacePoint& at, const vec3& r, float roughness) const override {
    return between_probes->glossy(at, r, roughness);
  }
};

/// Weights of the probes at each vertex.
struct VertexProbes {
  std::vector<std::uint32_t> begin{0};
  std::vector<probes::ProbeWeight> weights;

  VertexProbes(const TransferMesh& mesh, const probe_volume::VolumeWeights& volume) {
    for (const rays::SurfacePoint& vertex : mesh.vertices) {
      const probes::ProbeWeights at = volume.at(vertex);
      weights.insert(weights.end(), at.used().begin(), at.used().end());
      begin.push_back(static_cast<std::uint32_t>(weights.size()));
    }
  }
  std::span<const probes::ProbeWeight> of(std::size_t vertex) const {
    return std::span(weights).subspan(begin[vertex], begin[vertex + 1] - begin[vertex]);
  }
};

/// Distant light by transfer vectors from infinity (Sloan et al. 2002); all other light by the radiance of
/// probes around each vertex times a transfer vector of what is near (the paper's §2.2).
class Prt final : public Method {
 public:
  Prt(const MethodScene& scene, const MethodParameters& p, const Control& control)
      : source_(scene.source), volume_(scene, p, p.integer("degree"), control) {
    const bool by_transfer =
        scene.scene.environment && p.choice<EnvironmentLight>("environment") == EnvironmentLight::transfer;
    if (by_transfer) require_own_group(scene);
    const float radius = scene.source.part_bounds(0).radius();
    TransferMeshParams mesh_params;
    mesh_params.edge = static_cast<float>(p.number("edge"));
    if (!(mesh_params.edge > 0)) mesh_params.edge = usual_edge * radius;
    mesh_params.most = p.integer("vertices");
    const TransferMesh mesh = make_transfer_mesh(scene.scene, source_, mesh_params);
    light_.triangles = mesh.triangles;
    light_.index = MeshIndex(mesh, mesh_reach * radius);
    probes_.emplace(mesh, *volume_.weights());
    shown_spacing_ = shown_share * radius;
    shown_ = shown_vertices(mesh, shown_spacing_);

    const VertexRings rings(mesh);
    const VertexRays rays = find_vertex_rays(mesh, rings, light_.index, source_, p.integer("rays"), control);
    TransferParams params{p.integer("degree"), 0, p.integer("interreflect")};
    params.reach = static_cast<float>(p.number("self_shadow")) * std::min(volume_.spacing(), 2 * radius);
    near_ = params.reach > 0 ? find_transfer(mesh, rings, rays, params, control)
                             : open_transfer(mesh, params.degree);

    if (!by_transfer) return;
    params.reach = std::numeric_limits<float>::infinity();
    environment_ = &*scene.scene.environment;
    sky_ = project_environment(*environment_, params.degree);
    sky_rotation_ = environment_->rotation;
    from_sky_ = find_transfer(mesh, rings, rays, params, control);
    const std::vector<vec3> places = scene::positions_of(volume_.places());
    sky_to_probes_ =
        find_place_transfer(places, mesh, light_.index, from_sky_, source_, p.integer("directions"), control);
    from_sky_.direct = {};  // renderers find direct light themselves
  }

  void update(const scene::LightingState& state, const Control& control) override {
    const int group = sky_.empty() ? -1 : source_.environment_group();
    volume_.update(state, group, control);
    if (!sky_.empty() && state.environment_image != sky_image_) take_sky(state.environment_image);
    std::vector<sh::RadianceSh> around = volume_.radiance();
    sh::RadianceSh sky;
    if (!sky_.empty()) {
      sky = sh::Rotation::about_axis(sky_.degree(), vec3(0, 1, 0),
                                     static_cast<double>(sky_rotation_ + state.environment_rotation))
                .apply(sky_);
      sky *= state.group_scales[group];
    }
    light_.irradiance_of.resize(probes_->begin.size() - 1);
    parallel_for(light_.irradiance_of.size(), 256,
                 [&](std::size_t v) { light_.irradiance_of[v] = at_vertex(v, sky); });
    for (std::size_t i = 0; i < around.size() && !sky.empty(); ++i)
      around[i] += sky_to_probes_.radiance(i, sky);
    probes::LookupParams params;
    params.irradiance_degree = moving_degree;
    light_.between_probes.emplace(transport::lookup_set(volume_.places(), around), volume_.weights(), params);
  }

  const rays::IndirectLight& light() const override { return light_; }

  sketch::Sketch drawing(Drawing what) const override {
    if (what != Drawing::transfer) return volume_.drawing(what);
    return transfer_drawing(near_, shown_, lobe_share * shown_spacing_);
  }

  MethodMemory memory() const override {
    MethodMemory bytes = volume_.memory();
    bytes.lookup += volume_.places().size() * sh::coefficient_count(moving_degree) * sizeof(vec3) +
                    light_.triangles.size() * sizeof(uvec3) + light_.index.bytes() +
                    light_.irradiance_of.size() * sizeof(vec3);
    bytes.update += (near_.direct.size() + from_sky_.direct.size()) * sizeof(float) +
                    (near_.reflected.size() + from_sky_.reflected.size()) * sizeof(vec3) +
                    sky_to_probes_.matrix.size() * sizeof(vec3) +
                    probes_->weights.size() * sizeof(probes::ProbeWeight) +
                    probes_->begin.size() * sizeof(std::uint32_t);
    return bytes;
  }

  MethodNumbers numbers() const override {
    MethodNumbers numbers = volume_.numbers();
    numbers.emplace_back("vertices", static_cast<double>(light_.irradiance_of.size()));
    numbers.emplace_back("triangles", static_cast<double>(light_.triangles.size()));
    return numbers;
  }

 private:
  void require_own_group(const MethodScene& scene) const {
    const int group = source_.environment_group();
    bool shared = false;
    for (std::size_t i = 0; i < scene.scene.lights.size(); ++i)
      shared |= source_.light_group_of(static_cast<int>(i)) == group;
    for (const scene::Instance& instance : scene.scene.instances) {
      const int material = scene::instance_material(scene.scene, instance);
      if (material < 0 || !scene.scene.materials[material].emissive()) continue;
      shared |= scene::light_group_index(source_.light_groups(), scene::light_group(scene.scene, instance)) ==
                group;
    }
    if (shared) {
      throw Error("method prt",
                  fmt::format("the environment shares its light group \"{}\" with other lights",
                              source_.light_groups()[group]),
                  "give it a group of its own, or use environment=probes");
    }
  }

  /// Of this image in place of the scene's own.
  void take_sky(const std::shared_ptr<const image::Image>& image) {
    scene::Environment environment = *environment_;
    if (image) environment.equirect = *image;
    sky_ = project_environment(environment, sky_.degree());
    sky_image_ = image;
  }

  vec3 at_vertex(std::size_t v, const sh::RadianceSh& sky) const {
    vec3 sum(0);
    for (const probes::ProbeWeight& probe : probes_->of(v)) {
      const sh::RadianceSh& radiance = volume_.radiance()[probe.probe];
      sum += probe.weight * (near_.direct_irradiance(v, radiance) + near_.reflected_irradiance(v, radiance));
    }
    if (!sky.empty()) sum += from_sky_.reflected_irradiance(v, sky);
    return glm::max(sum, vec3(0));
  }

  const rays::TransportSource& source_;
  probe_volume::ProbeVolume volume_;
  std::optional<VertexProbes> probes_;
  TransferVectors near_, from_sky_;
  PlaceTransfer sky_to_probes_;
  sh::RadianceSh sky_;  ///< at rotation 0; empty: the environment lights the probes as all else does
  float sky_rotation_ = 0;
  const scene::Environment* environment_ = nullptr;  ///< of the scene, where sky_ is not empty
  std::shared_ptr<const image::Image> sky_image_;    ///< that sky_ is of; null: the environment's own
  VertexLight light_;
  std::vector<ShownVertex> shown_;  ///< for drawing() alone
  float shown_spacing_ = 0;
};

}  // namespace

MethodEntry entry() {
  std::vector<MethodParameter> parameters = probe_volume::probe_volume_parameters();
  const MethodParameter own[] = {
      {"degree", 4, 0, 10, "of transfer vectors and of the probes' radiance", true},
      {"interreflect", 3, 0, 64, "bounces within the transfer vectors; 0: shadowed only", true},
      {"self_shadow", 0.25, 0, 1e6,
       "nearer than this share of the probes' spacing, surfaces hide and reflect their light; 0: none do"},
      choice_parameter("environment", EnvironmentLight::transfer,
                       "by transfer vectors from infinity, or in the probes as all other light"),
      {"rays", 256, 16, 65536, "per vertex", true},
      {"edge", 0, 0, 1e4, "longest of the mesh [m]; 0: a 14th of the scene's radius"},
      {"vertices", 1 << 18, 3, 1 << 26, "more are refused", true}};
  parameters.insert(parameters.end(), std::begin(own), std::end(own));
  return {"prt",
          "precomputed radiance transfer: vertices that know how distant light reaches them",
          std::move(parameters),
          [](const MethodScene& scene, const MethodParameters& p, const Control& control)
              -> std::unique_ptr<Method> { return std::make_unique<Prt>(scene, p, control); },
          false,
          {Drawing::transfer, Drawing::tetrahedra, Drawing::surfels, Drawing::links}};
}

}  // namespace ssphh::methods::prt
