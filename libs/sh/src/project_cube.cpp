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
      classes[coefficient_index(l, m)] = odd_x | odd_y << 1 | odd_z << 2;
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

using float4 = float __attribute__((vector_size(16)));

SSPHH_IN_LOOP inline float8 join(const float* low, const float* high) {
  float4 a, b;
  __builtin_memcpy(&a, low, sizeof a);
  __builtin_memcpy(&b, high, sizeof b);
  return __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7);
}

// Eight consecutive RGB texels to one vector per channel: five shuffles within 128-bit halves (Melax, 3D
// Vector Normalization Using 256-Bit Intel AVX, 2011). `backwards` reverses the texels at no cost.
SSPHH_IN_LOOP inline void load_rgb8(const float* p, bool backwards, float8* rgb) {
  const int low = backwards ? 12 : 0, high = 12 - low;
  const float8 a = join(p + low, p + high);          // r g b r per half
  const float8 b = join(p + low + 4, p + high + 4);  // g b r g
  const float8 c = join(p + low + 8, p + high + 8);  // b r g b
  const float8 rg = __builtin_shufflevector(b, c, 2, 3, 9, 10, 6, 7, 13, 14);
  const float8 gb = __builtin_shufflevector(a, b, 1, 2, 8, 9, 5, 6, 12, 13);
  if (backwards) {
    rgb[0] = __builtin_shufflevector(rg, a, 2, 0, 11, 8, 6, 4, 15, 12);
    rgb[1] = __builtin_shufflevector(rg, gb, 3, 1, 10, 8, 7, 5, 14, 12);
    rgb[2] = __builtin_shufflevector(c, gb, 3, 0, 11, 9, 7, 4, 15, 13);
  } else {
    rgb[0] = __builtin_shufflevector(a, rg, 0, 3, 8, 10, 4, 7, 12, 14);
    rgb[1] = __builtin_shufflevector(gb, rg, 0, 2, 9, 11, 4, 6, 13, 15);
    rgb[2] = __builtin_shufflevector(gb, c, 1, 3, 8, 11, 5, 7, 12, 15);
  }
}

// Texels column, column ± 1, … of one row; lanes beyond `lanes` are 0.
SSPHH_IN_LOOP inline void load_texels(const float* row, int column, bool backwards, int lanes, int channels,
                                      float8* rgb) {
  if (lanes == lane_count && channels == 3) {
    load_rgb8(row + 3 * (backwards ? column - (lane_count - 1) : column), backwards, rgb);
    return;
  }
  for (int c = 0; c < 3; ++c) rgb[c] = float8{};
  for (int i = 0; i < lanes; ++i) {
    const float* p = row + channels * (backwards ? column - i : column + i);
    for (int c = 0; c < 3; ++c) rgb[c][i] = p[c];
  }
}

SSPHH_IN_LOOP inline void butterfly(float8& even, float8& odd) {
  const float8 sum = even + odd;
  odd = even - odd;
  even = sum;
}

// light[class] = weight · Σ_octant ± light[octant], negative where class and octant share an odd number of
// bits.
SSPHH_IN_LOOP inline void combine_octants(const float8& weight, float8* light) {
  for (int c = 0; c < 3; ++c) {
    float8 v0 = light[c] * weight, v1 = light[3 + c] * weight, v2 = light[6 + c] * weight,
           v3 = light[9 + c] * weight;
    float8 v4 = light[12 + c] * weight, v5 = light[15 + c] * weight, v6 = light[18 + c] * weight,
           v7 = light[21 + c] * weight;
    butterfly(v0, v1), butterfly(v2, v3), butterfly(v4, v5), butterfly(v6, v7);
    butterfly(v0, v2), butterfly(v1, v3), butterfly(v4, v6), butterfly(v5, v7);
    butterfly(v0, v4), butterfly(v1, v5), butterfly(v2, v6), butterfly(v3, v7);
    light[c] = v0, light[3 + c] = v1, light[6 + c] = v2, light[9 + c] = v3;
    light[12 + c] = v4, light[15 + c] = v5, light[18 + c] = v6, light[21 + c] = v7;
  }
}

SSPHH_IN_LOOP inline float8 load8(const std::vector<float>& values, int first) {
  float8 v;
  __builtin_memcpy(&v, &values[first], sizeof v);
  return v;
}

int padded(int count) {
  return (count + lane_count - 1) / lane_count * lane_count;
}

}  // namespace

CubeProjector::CubeProjector(int degree, int face_size)
    : degree_(degree), face_size_(face_size), half_(face_size - face_size / 2) {
  require_degree(degree, "cube projector");
  require(face_size >= 1, "cube projector", "a face needs texels");
  const int stride = padded(half_);
  half_coordinates_.resize(static_cast<std::size_t>(stride));
  half_major_.resize(static_cast<std::size_t>(stride) * static_cast<std::size_t>(half_));
  half_solid_angles_.resize(half_major_.size());
  const auto coordinate = [&](int i) { return (2.0 * (face_size / 2 + i) + 1) / face_size - 1; };
  for (int i = 0; i < half_; ++i) half_coordinates_[i] = static_cast<float>(coordinate(i));
  // The middle row and column of an odd size are their own mirror image: they are met twice.
  const auto share = [&](int i) { return face_size % 2 == 1 && i == 0 ? 0.5 : 1.0; };
  for (int j = 0; j < half_; ++j) {
    for (int i = 0; i < half_; ++i) {
      const auto at = static_cast<std::size_t>(j * stride + i);
      const double s = coordinate(i), t = coordinate(j);
      const double angle = texel_solid_angle(face_size / 2 + i, face_size / 2 + j, face_size);
      half_major_[at] = static_cast<float>(1 / std::sqrt(s * s + t * t + 1));
      half_solid_angles_[at] = static_cast<float>(share(i) * share(j) * angle);
    }
  }
}

RadianceSh CubeProjector::project(const CubeFaces& faces, int channels) const {
  require(channels == 3 || channels == 4, "cube projector", "a texel must have 3 or 4 channels");
  const std::size_t texels = static_cast<std::size_t>(face_size_) * static_cast<std::size_t>(face_size_);
  for (const auto& face : faces)
    require(face.size() == texels * static_cast<std::size_t>(channels), "cube projector",
            "a face is not of the projector's size");

  static const std::array<int, max_coefficient_count> classes = parity_classes();
  ProjectionSum sum(degree_, octant_count, classes);
  const int stride = padded(half_), middle = face_size_ / 2;
  for_this_cpu([&]() SSPHH_IN_LOOP {
    for (int axis = 0; axis < 3; ++axis) {
      OctantPlace places[octant_count];
      for (int octant = 0; octant < octant_count; ++octant) places[octant] = octant_place(axis, octant);
      for (int j = 0; j < half_; ++j) {
        const float t = half_coordinates_[j];
        for (int i = 0; i < half_; i += lane_count) {
          const int lanes = std::min(lane_count, half_ - i);

          // Evaluate the basis in the octant where x, y and z are positive.
          const float8 s = load8(half_coordinates_, i);
          const float8 major = load8(half_major_, j * stride + i);
          const float8 across = s * major, down = t * major;
          if (axis == 0) {
            sum.add_direction_block(major, down, across);
          } else if (axis == 1) {
            sum.add_direction_block(across, major, down);
          } else {
            sum.add_direction_block(across, down, major);
          }

          // Read the eight mirror images and form their even and odd sums.
          float8* light = sum.light();
          for (int octant = 0; octant < octant_count; ++octant) {
            const OctantPlace& place = places[octant];
            const int y = place.mirrored_rows ? face_size_ - 1 - middle - j : middle + j;
            const int x = place.mirrored_columns ? face_size_ - 1 - middle - i : middle + i;
            const float* row = faces[place.face].data() +
                               static_cast<std::size_t>(y) * static_cast<std::size_t>(face_size_ * channels);
            load_texels(row, x, place.mirrored_columns, lanes, channels, light + octant * 3);
          }
          combine_octants(load8(half_solid_angles_, j * stride + i), light);
          sum.finish_block();
        }
      }
    }
  });
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
