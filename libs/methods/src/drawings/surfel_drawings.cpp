#include <algorithm>
#include <cmath>

#include <ssphh/methods/drawing.h>

namespace ssphh::methods {
namespace {

constexpr float share_of_voxel = 0.45f;  // that a disc's radius has of the voxel's edge
constexpr std::size_t shown_sources = 6;

/// The surfel where it stands now.
sketch::Disc disc_of(const transport::TransportNetwork& network, std::size_t surfel) {
  const transport::Surfel& s = network.surfels().surfels()[surfel];
  const mat4& pose = network.poses()[s.part];
  return {.center = vec3(pose * vec4(s.point.position, 1)),
          .normal = glm::normalize(mat3(pose) * s.point.normal),
          .radius = share_of_voxel * network.surfels().size(s.level),
          .color = s.albedo};
}

}  // namespace

sketch::Sketch surfels_drawing(const transport::TransportNetwork& network) {
  sketch::Sketch marks;
  for (std::size_t i = 0; i < network.surfel_count(); ++i) marks.discs.push_back(disc_of(network, i));
  return marks;
}

sketch::Sketch links_drawing(const transport::TransportNetwork& network) {
  const auto& rows = network.links().rows;
  const std::size_t step = std::max<std::size_t>(1, rows.size() / shown_sources);
  sketch::Sketch marks;
  for (std::size_t i = step / 2; i < rows.size(); i += step) {
    sketch::Disc from = disc_of(network, i);
    float largest = 0;
    for (const auto& links : {rows[i].fixed, rows[i].moving})
      for (const transport::Link& link : links) largest = std::max(largest, link.weight);
    for (const auto& links : {rows[i].fixed, rows[i].moving}) {
      for (const transport::Link& link : links) {
        const float share = link.weight / largest;
        marks.lines.push_back({from.center, disc_of(network, network.surfel_of(link.patch)).center,
                               glm::mix(vec3(0.03f, 0.15f, 0.9f), vec3(1, 1, 0.8f), share), 0.8f + share});
      }
    }
    from.color = vec3(1, 0.35f, 0);
    marks.discs.push_back(from);
  }
  return marks;
}

}  // namespace ssphh::methods
