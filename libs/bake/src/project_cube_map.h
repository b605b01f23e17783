#pragma once

#include <ssphh/image/cube_map.h>
#include <ssphh/sh/project.h>

namespace ssphh::bake {

inline sh::RadianceSh project_cube_map(const sh::CubeProjector& projector, const image::CubeMap& cube) {
  sh::CubeFaces faces;
  for (std::size_t f = 0; f < 6; ++f) {
    require(cube.faces[f].channels == cube.faces[0].channels, "cube map", "its faces differ in channels");
    faces[f] = cube.faces[f].pixels;
  }
  return projector.project(faces, cube.faces[0].channels);
}

}  // namespace ssphh::bake
