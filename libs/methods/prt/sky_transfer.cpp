#include "sky_transfer.h"

#include <array>

#include <ssphh/core/parallel.h>
#include <ssphh/core/sphere.h>
#include <ssphh/image/sphere_map.h>
#include <ssphh/sh/evaluate.h>
#include <ssphh/sh/project.h>

namespace ssphh::methods::prt {

sh::RadianceSh project_environment(const scene::Environment& environment, int degree) {
  if (environment.equirect.empty()) {
    sh::RadianceSh constant(degree);
    constant[0] = environment.color * std::sqrt(4 * pi);
    return constant;
  }
  const int width = environment.equirect.width, height = environment.equirect.height;
  std::vector<vec3> directions, radiance;
  std::vector<double> solid_angles;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      directions.push_back(
          image::equirect_direction((static_cast<float>(x) + 0.5f) / static_cast<float>(width),
                                    (static_cast<float>(y) + 0.5f) / static_cast<float>(height)));
      radiance.push_back(environment.color * environment.equirect.rgb(x, y));
      solid_angles.push_back(image::equirect_solid_angle(y, width, height));
    }
  }
  return sh::project(degree, directions, solid_angles, radiance);
}

sh::RadianceSh PlaceTransfer::radiance(std::size_t place, const sh::RadianceSh& light) const {
  sh::RadianceSh out(degree);
  const std::size_t n = out.values.size();
  for (std::size_t row = 0; row < n; ++row)
    for (std::size_t k = 0; k < n; ++k)
      out.values[row] += matrix[(place * n + row) * n + k] * light.values[k];
  return out;
}

PlaceTransfer find_place_transfer(std::span<const vec3> places, const TransferMesh& mesh,
                                  const MeshIndex& index, const TransferVectors& transfer,
                                  const rays::TransportSource& source, int rays, const Control& control) {
  const std::size_t n = transfer.stride(), count = static_cast<std::size_t>(rays);
  PlaceTransfer result{transfer.degree, std::vector<vec3>(places.size() * n * n, vec3(0))};
  const float solid_angle = 4 * pi / static_cast<float>(rays);
  parallel_for(
      places.size(), 1,
      [&](std::size_t begin, std::size_t end) {
        std::vector<rays::RayQuery> queries(count);
        std::vector<rays::RayHit> hits(count);
        std::vector<vec3> leaving(n);
        std::array<float, sh::max_coefficient_count> basis;
        for (std::size_t p = begin; p < end; ++p) {
          for (int r = 0; r < rays; ++r) queries[r] = {places[p], spherical_fibonacci(r, rays)};
          source.intersect(0, queries, hits);
          for (std::size_t r = 0; r < count; ++r) {
            if (hits[r].escaped()) continue;
            const MeshPlace at =
                index.find({places[p] + hits[r].distance * queries[r].direction, hits[r].normal});
            if (at.triangle < 0) continue;
            const uvec3& t = mesh.triangles[at.triangle];
            std::ranges::fill(leaving, vec3(0));
            for (int c = 0; c < 3; ++c) {
              const vec3 factor = solid_angle / pi * at.weight[c] * hits[r].through * hits[r].albedo;
              for (std::size_t k = 0; k < n; ++k) {
                vec3 irradiance(transfer.direct[t[c] * n + k]);
                if (!transfer.reflected.empty()) irradiance += transfer.reflected[t[c] * n + k];
                leaving[k] += factor * irradiance;
              }
            }
            sh::eval_basis(transfer.degree, queries[r].direction, std::span(basis).first(n));
            for (std::size_t row = 0; row < n; ++row)
              for (std::size_t k = 0; k < n; ++k)
                result.matrix[(p * n + row) * n + k] += basis[row] * leaving[k];
          }
        }
      },
      control);
  return result;
}

}  // namespace ssphh::methods::prt
