#include "commands/measure_regions.h"

#include <algorithm>

#include <ssphh/core/parse_number.h>
#include <ssphh/study/inside.h>

namespace ssphh::app {

NamedBox read_named_box(const std::string& text) {
  const auto wrong = [&](const std::string& problem) {
    return Error("--region " + text, problem, "it is NAME=x0,y0,z0,x1,y1,z1, the lower corner first");
  };
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos) throw wrong("there is no name");
  NamedBox result{text.substr(0, equals), {}};
  if (result.name == "inside" || result.name == "outside" || result.name == "all")
    throw wrong("every scene has a region of this name");
  const auto numbers = parse_numbers(std::string_view(text).substr(equals + 1));
  if (!numbers || numbers->size() != 6) throw wrong("its six numbers cannot be read");
  const std::vector<float>& n = *numbers;
  result.box = {{n[0], n[1], n[2]}, {n[3], n[4], n[5]}};
  if (!glm::all(glm::lessThan(result.box.min, result.box.max))) throw wrong("it is no box");
  return result;
}

void require_different_names(const std::vector<NamedBox>& boxes) {
  for (const NamedBox& named : boxes)
    if (std::ranges::count(boxes, named.name, &NamedBox::name) > 1)
      throw Error("--region " + named.name, "there are two of this name");
}

std::vector<MeasuredRegion> inside_and_outside(const rays::TransportSource& source,
                                               const std::vector<rays::SurfacePoint>& points,
                                               const study::TruthAtPoints& truth, float time) {
  const std::vector<std::uint8_t> is_inside = study::inside(source, points, time);
  std::vector<MeasuredRegion> regions = {{"inside", {}, {}}, {"outside", {}, {}}};
  for (std::size_t i = 0; i < points.size(); ++i) {
    MeasuredRegion& region = regions[is_inside[i] ? 0 : 1];
    region.points.push_back(points[i]);
    region.truth.estimates.push_back(truth.estimates[i]);
    region.truth.dark_at.push_back(truth.dark_at[i]);
    region.truth.dark += truth.dark_at[i];
    region.truth.spp = truth.spp;
  }
  std::erase_if(regions, [](const MeasuredRegion& region) { return region.points.empty(); });
  return regions;
}

}  // namespace ssphh::app
