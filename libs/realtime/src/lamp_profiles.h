#pragma once
/// Photometric profiles of a scene's lamps as layers of a texture.

#include <vector>

#include <ssphh/gl/texture.h>
#include <ssphh/scene/scene.h>

namespace ssphh::realtime {

/// Each layer holds shares of the greatest intensity, evenly by the angle from the pole along its rows and by
/// the angle about it down its columns.
class LampProfiles {
 public:
  LampProfiles() = default;
  explicit LampProfiles(const std::vector<scene::Light>& lights);

  /// Of a light among those; −1: it has no profile.
  int layer(const scene::Light& light) const;
  /// Does nothing where there is no profile.
  void bind() const;
  std::size_t bytes() const { return texture_.id() ? texture_.bytes() : 0; }

 private:
  std::vector<scene::LampProfile> profiles_;
  gl::Texture texture_;
};

}  // namespace ssphh::realtime
