#pragma once
/// What `render` was asked for, and how its pictures are written, whoever makes them.

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include <ssphh/image/image.h>
#include <ssphh/image/tonemap.h>
#include <ssphh/probes/lookup.h>

#include "options/farm_options.h"
#include "options/scene_options.h"

namespace ssphh::app {

struct RenderOptions {
  SceneOptions scene;
  FarmChoice farm;
  std::string output, png, method = "path", probes, camera, at, projection = "camera", backend = "cpu";
  image::ToneCurve tonemap = image::ToneCurve::clip;
  probes::LookupSpec lookup;  ///< of the probes
  std::vector<std::string> aovs, parameters;
  int width = 1280, height = 720, max_depth = 3, passes = 1, spp = 16;
  float exposure = 0;
  float occlusion = 0;  ///< metres; 0: none
  int indirect_scale = 1;
  bool resume = false, force = false;
};

/// Tone mapped, whatever the format.
void write_display(const std::filesystem::path& path, const image::Image& linear, const RenderOptions& o);

/// Linear radiance, or tone mapped where the format holds 8 bits.
void write_picture(const std::filesystem::path& path, const image::Image& linear, const RenderOptions& o);

/// Per channel.
std::array<double, 3> mean_radiance(const image::Image& picture);

}  // namespace ssphh::app
