#include <algorithm>
#include <cmath>

#include <ssphh/core/sphere.h>
#include <ssphh/sh/project.h>

#include "projection_sum.h"

namespace ssphh::sh {
namespace {

constexpr int octant_count = 8;

// Bit 0, 1, 2 of a class or octant: odd (or negative) in x, y, z.
std::array<int, max_coefficient_count> parity_classes() {
  std::array<int, max_coefficient_count> classes{};
  for (int l = 0; l <= max_degree; ++l) {
    for (int m = -l; m <= l; ++m) {
      const int order = std::abs(m);
      const int odd_y = m < 0 ? 1 : 0;
      const int odd_x = (order + odd_y) & 1;
      const int odd_z = (l - order) & 1;
      classes[static_cast<std::size_t>(coefficient_index(l, m))] = odd_x | odd_y << 1 | odd_z << 2;
    }
  }
  return classes;
}

// Where the texels of one octant lie: the face, and whether its columns and rows run away from the centre
// backwards.
struct OctantPlace {
  int face;
  bool mirrored_columns, mirrored_rows;
};

// `axis` is the face pair's axis; see cube_direction_unnormalized for the signs.
OctantPlace octant_place(int axis, int octant) {
  const bool negative[3] = {(octant & 1) != 0, (octant & 2) != 0, (octant & 4) != 0};
  const bool back = negative[axis];
  const int face = 2 * axis + (back ? 1 : 0);
  switch (axis) {
    case 0:
      return {face, negative[2] == back, !negative[1]};
    case 1:
      return {face, negative[0], negative[2] != back};
    default:
      return {face, negative[0] != back, !negative[1]};
  }
}

struct Rgb8 {
  float8 r, g, b;
};

// Eight consecutive RGB texels, from interleaved to one vector per channel.
Rgb8 load_rgb8(const float* p) {
  float8 a, b, c;
  __builtin_memcpy(&a, p, sizeof a);
  __builtin_memcpy(&b, p + 8, sizeof b);
  __builtin_memcpy(&c, p + 16, sizeof c);
  const float8 r = __builtin_shufflevector(a, b, 0, 3, 6, 9, 12, 15, 0, 0);
  const float8 g = __builtin_shufflevector(a, b, 1, 4, 7, 10, 13, 0, 0, 0);
  const float8 blue = __builtin_shufflevector(a, b, 2, 5, 8, 11, 14, 0, 0, 0);
  return {__builtin_shufflevector(r, c, 0, 1, 2, 3, 4, 5, 10, 13),
          __builtin_shufflevector(g, c, 0, 1, 2, 3, 4, 8, 11, 14),
          __builtin_shufflevector(blue, c, 0, 1, 2, 3, 4, 9, 12, 15)};
}

float8 reversed(const float8& v) {
  return __builtin_shufflevector(v, v, 7, 6, 5, 4, 3, 2, 1, 0);
}

// Texels column, column ± 1, … of one row; lanes beyond `lanes` are 0.
Rgb8 load_texels(const float* row, int column, bool backwards, int lanes, int channels) {
  if (lanes == lane_count && channels == 3) {
    if (!backwards) return load_rgb8(row + 3 * column);
    const Rgb8 texels = load_rgb8(row + 3 * (column - (lane_count - 1)));
    return {reversed(texels.r), reversed(texels.g), reversed(texels.b)};
  }
  Rgb8 texels{};
  for (int i = 0; i < lanes; ++i) {
    const float* p = row + channels * (backwards ? column - i : column + i);
    texels.r[i] = p[0], texels.g[i] = p[1], texels.b[i] = p[2];
  }
  return texels;
}

// light[class] = Σ_octant ± light[octant], the sign by the bits they share.
void combine_octants(float8* light) {
  for (int bit = 1; bit < octant_count; bit *= 2) {
    for (int octant = 0; octant < octant_count; ++octant) {
      if (octant & bit) continue;
      for (int c = 0; c < 3; ++c) {
        float8& even = light[octant * 3 + c];
        float8& odd = light[(octant | bit) * 3 + c];
        const float8 sum = even + odd;
        odd = even - odd;
        even = sum;
      }
    }
  }
}

int padded(int count) {
  return (count + lane_count - 1) / lane_count * lane_count;
}

}  // namespace

CubeProjector::CubeProjector(int degree, int face_size)
    : degree_(degree), face_size_(face_size), half_(face_size - face_size / 2) {
  SSPHH_CHECK(degree >= 0 && degree <= max_degree && face_size >= 1);
  const int stride = padded(half_);
  half_coordinates_.resize(static_cast<std::size_t>(stride));
  half_solid_angles_.resize(static_cast<std::size_t>(stride) * static_cast<std::size_t>(half_));
  for (int i = 0; i < half_; ++i) {
    half_coordinates_[static_cast<std::size_t>(i)] =
        static_cast<float>((2.0 * (face_size / 2 + i) + 1) / face_size - 1);
  }
  // The middle row and column of an odd size are their own mirror image: they are met twice.
  const auto share = [&](int i) { return face_size % 2 == 1 && i == 0 ? 0.5 : 1.0; };
  for (int j = 0; j < half_; ++j) {
    for (int i = 0; i < half_; ++i) {
      const double angle = texel_solid_angle(face_size / 2 + i, face_size / 2 + j, face_size);
      half_solid_angles_[static_cast<std::size_t>(j * stride + i)] =
          static_cast<float>(share(i) * share(j) * angle);
    }
  }
}

RadianceSh CubeProjector::project(const CubeFaces& faces, int channels) const {
  SSPHH_CHECK(channels == 3 || channels == 4);
  const std::size_t texels = static_cast<std::size_t>(face_size_) * static_cast<std::size_t>(face_size_);
  for (const auto& face : faces) SSPHH_CHECK(face.size() == texels * static_cast<std::size_t>(channels));

  static const std::array<int, max_coefficient_count> classes = parity_classes();
  ProjectionSum sum(degree_, octant_count, classes);
  const int stride = padded(half_), middle = face_size_ / 2;
  for (int axis = 0; axis < 3; ++axis) {
    OctantPlace places[octant_count];
    for (int octant = 0; octant < octant_count; ++octant) places[octant] = octant_place(axis, octant);
    for (int j = 0; j < half_; ++j) {
      const float t = half_coordinates_[static_cast<std::size_t>(j)];
      for (int i = 0; i < half_; i += lane_count) {
        const int lanes = std::min(lane_count, half_ - i);

        // Evaluate the basis in the octant where x, y and z are positive.
        float8 s, major;
        __builtin_memcpy(&s, &half_coordinates_[static_cast<std::size_t>(i)], sizeof s);
        const float8 square = s * s + (t * t + 1);
        for (int lane = 0; lane < lane_count; ++lane) major[lane] = 1 / std::sqrt(square[lane]);
        const float8 across = s * major, down = t * major;
        if (axis == 0) {
          sum.add_direction_block(major, down, across);
        } else if (axis == 1) {
          sum.add_direction_block(across, major, down);
        } else {
          sum.add_direction_block(across, down, major);
        }

        // Read the eight mirror images and form their even and odd sums.
        float8 weight;
        __builtin_memcpy(&weight, &half_solid_angles_[static_cast<std::size_t>(j * stride + i)],
                         sizeof weight);
        float8* light = sum.light();
        for (int octant = 0; octant < octant_count; ++octant) {
          const OctantPlace& place = places[octant];
          const int y = place.mirrored_rows ? face_size_ - 1 - middle - j : middle + j;
          const int x = place.mirrored_columns ? face_size_ - 1 - middle - i : middle + i;
          const float* row = faces[static_cast<std::size_t>(place.face)].data() +
                             static_cast<std::size_t>(y) * static_cast<std::size_t>(face_size_ * channels);
          const Rgb8 rgb = load_texels(row, x, place.mirrored_columns, lanes, channels);
          light[octant * 3] = rgb.r * weight;
          light[octant * 3 + 1] = rgb.g * weight;
          light[octant * 3 + 2] = rgb.b * weight;
        }
        combine_octants(light);
        sum.finish_block();
      }
    }
  }
  return sum.result();
}

std::uint64_t CubeProjector::executed_fma_count() const {
  return std::uint64_t{9} * static_cast<std::uint64_t>(padded(half_)) * static_cast<std::uint64_t>(half_) *
         static_cast<std::uint64_t>(coefficient_count(degree_));
}

RadianceSh project_cube(int degree, int face_size, const CubeFaces& faces, int channels) {
  return CubeProjector(degree, face_size).project(faces, channels);
}

}  // namespace ssphh::sh
