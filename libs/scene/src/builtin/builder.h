#pragma once
/// Short ways to put together a scene by hand.

#include <string>

#include <ssphh/scene/primitives.h>
#include <ssphh/scene/scene.h>

namespace ssphh::scene {

class Builder {
 public:
  explicit Builder(std::string name) { scene_.name = std::move(name); }

  /// Diffuse only (specular = 0). Returns the material's index.
  int matte(const std::string& name, const vec3& albedo, const vec3& emission = vec3(0));
  /// Dielectric with a specular lobe of the given GGX roughness.
  int glossy(const std::string& name, const vec3& albedo, float roughness, float metallic = 0);
  int metal(const std::string& name, const vec3& f0, float roughness);
  /// thin_glass().
  int pane(const std::string& name, const vec3& tint);
  /// solid_glass() of index `ior`.
  int body(const std::string& name, const vec3& color, float distance, float ior);

  /// On `parent`, or on what `stand_on` named.
  int node(const std::string& name, const Transform& local = {}, int parent = -1);
  /// Nodes made from now on stand on this one; −1: on the world.
  void stand_on(int node) { parent_ = node; }
  /// A mesh at a new node. Returns the mesh's index.
  int add(const std::string& name, Mesh mesh, int material, const Transform& local = {});
  /// Another instance of a mesh, with its own material.
  void again(const std::string& name, int mesh, int material, const Transform& local);
  /// A mesh at a node that exists.
  void add_at(int node, const std::string& name, Mesh mesh, int material);
  /// An emissive mesh in the named light group.
  void add_emitter(const std::string& name, const std::string& group, Mesh mesh, const vec3& radiance);

  /// Looks from `eye` to `target`; `yfov` in degrees; 16:9 unless said.
  void camera(const std::string& name, const vec3& eye, const vec3& target, float yfov,
              float aspect = 16.0f / 9);
  void point_light(const std::string& name, const vec3& position, const vec3& color, float intensity,
                   const std::string& group = {});
  void sphere_light(const std::string& name, const vec3& position, float radius, const vec3& color,
                    float radiance, const std::string& group = {});
  /// `inner`, `outer` in degrees from the axis.
  void spot_light(const std::string& name, const vec3& position, const vec3& target, const vec3& color,
                  float intensity, float inner, float outer, const std::string& group = {});
  void sphl(const std::string& name, const vec3& position, float radius = 0.1f);
  /// One that shines, too.
  void sphl(const std::string& name, const vec3& position, float radius, Emission emission, float intensity);

  Scene& scene() { return scene_; }
  /// Validates: a built-in scene needs no repair.
  Scene finish();

 private:
  int add_material(Material material);
  Light& light(const std::string& name, LightType type, const Transform& place, const vec3& color,
               float intensity, const std::string& group);

  Scene scene_;
  int parent_ = -1;
};

/// A thin sheet of smooth glass that keeps `tint` of what goes through it once.
Material thin_glass(const std::string& name, const vec3& tint);
/// Solid smooth glass: of white light `color` is left after `distance` metres.
Material solid_glass(const std::string& name, const vec3& color, float distance);

inline Transform at(const vec3& translation) {
  return {translation, quat(1, 0, 0, 0), vec3(1)};
}
/// `degrees` about `axis`, then moved.
Transform at(const vec3& translation, float degrees, const vec3& axis);
/// At `eye`, with −z toward `target` and y upward as far as possible.
Transform looking_at(const vec3& eye, const vec3& target);

}  // namespace ssphh::scene
