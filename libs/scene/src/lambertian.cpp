#include <optional>

#include <ssphh/scene/lambertian.h>

namespace ssphh::scene {

Scene lambertian(Scene scene) {
  std::optional<int> plain;
  for (Mesh& mesh : scene.meshes) {
    if (mesh.material >= 0) continue;
    if (!plain) {
      plain = static_cast<int>(scene.materials.size());
      scene.materials.emplace_back();
    }
    mesh.material = *plain;
  }
  for (Material& material : scene.materials) {
    material.metallic = material.specular = material.diffuse_roughness = 0;
    material.metallic_roughness_texture = material.normal_texture = {};
  }
  return scene;
}

}  // namespace ssphh::scene
