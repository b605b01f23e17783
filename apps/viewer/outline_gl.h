#pragma once
/// Draws the outline of bodies with OpenGL, as a picture of its own that lies over the scene's.

#include <memory>
#include <vector>

#include <ssphh/gl/texture.h>
#include <ssphh/scene/scene.h>

namespace ssphh::viewer {

class OutlineGl {
 public:
  OutlineGl();
  ~OutlineGl();
  OutlineGl(const OutlineGl&) = delete;
  OutlineGl& operator=(const OutlineGl&) = delete;

  /// The bodies from now on: indices of the scene's instances. Their meshes are uploaded.
  void set(const scene::Scene& scene, const std::vector<int>& instances);
  bool empty() const;

  /// Around what they cover, two pixels wide: strong where one of them is seen, faint where others hide them.
  /// `world`: the scene's matrices. `depth` and `view_projection` as realtime::Renderer tells of its frame.
  void draw(const std::vector<mat4>& world, const gl::Texture& depth, const mat4& view_projection, int width,
            int height);
  /// Of the last draw(): RGBA, empty but for the line.
  const gl::Texture& picture() const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace ssphh::viewer
