#pragma once
/// What the steps of `ssphh web` share.

#include <cstddef>
#include <string>
#include <vector>

#include <ssphh/image/image.h>
#include <ssphh/lightmap/plan.h>
#include <ssphh/trace/transport_scene.h>

#include "commands/web.h"
#include "results/web_folder.h"

namespace ssphh::app {

/// What is lit, and where.
struct LitStage {
  const WebOptions& options;
  const scene::Scene& scene;
  const trace::SharedGeometry geometry;
  const trace::TransportScene source;
  const lightmap::Plan& plan;
};

/// The first digits of the content's hash stand in the name: a changed file is no old one of a cache.
FolderFile hashed_file(const std::string& stem, const std::string& ending, std::vector<std::byte> data);

/// A lightmap as the page reads it: halves, rounded to the 9 bits that it keeps, deflated.
std::vector<std::byte> packed_light(const image::Image& atlas);

}  // namespace ssphh::app
