#pragma once
/// All programs of the renderer, made together and replaced together when a file changes.

#include <filesystem>
#include <string>

#include <ssphh/gl/program.h>

namespace ssphh::realtime {

struct Shaders {
  gl::Program geometry, shadow, shadow_alpha, direct, indirect, occlusion, compose, resolve, display;

  explicit Shaders(const gl::ShaderFiles& files);
  std::string warnings() const;
};

}  // namespace ssphh::realtime
