#pragma once
/// A camera's picture of where probes leak.

#include <filesystem>

#include <ssphh/image/image.h>
#include <ssphh/scene/query.h>
#include <ssphh/study/leak.h>

namespace ssphh::app {

struct LeakMap {
  image::Image grey;  ///< one channel, 0..1: the scene, lit by a lamp at the eye
  /// One channel: looked-up irradiance at pixels that are dark, in shares of the mean true one; 0 elsewhere.
  image::Image leaked;
  std::size_t dark = 0;  ///< pixels
};

/// The surface at each pixel's centre, looked up and path traced. `params.mean` must be set.
LeakMap leak_map(const rays::TransportSource& surfaces, float time, const scene::CameraPose& camera,
                 int width, int height, const rays::RadianceSource& source, const rays::IndirectLight& lookup,
                 const study::LeakParams& params, const Control& control);

/// .exr: `leaked` as numbers; .png: in colours over the grey scene. Returns the share shown in the last
/// colour (0 for numbers).
float write_leak_map(const std::filesystem::path& path, const LeakMap& map);

}  // namespace ssphh::app
