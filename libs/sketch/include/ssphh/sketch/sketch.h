#pragma once
/// Lines, discs, boxes, balls and lobes in space, as plain data: what shows how a method works, to be drawn
/// over a picture (sketch/draw.h).
///
/// Colours are display-linear, 0..1, and look the same at any exposure of the picture; those of marks that
/// are `light` are radiance [W sr⁻¹ m⁻²], exposed with the picture.

#include <array>
#include <span>
#include <vector>

#include <ssphh/sh/coefficients.h>

namespace ssphh::sketch {

/// Straight in space, however the picture bends it.
struct Line {
  vec3 a{0}, b{0};  ///< [m]
  vec3 color{1};
  float width = 1.5f;  ///< [pixels]
};

/// Flat, alike from both sides, with a dark rim.
struct Disc {
  vec3 center{0}, normal{0, 1, 0};  ///< [m]; unit
  float radius = 1;                 ///< [m]
  vec3 color{1};
  bool light = false;
};

/// Along the axes, one colour for each side: +x −x +y −y +z −z.
struct Box {
  vec3 min{0}, max{1};  ///< [m]
  std::array<vec3, 6> colors{};
  bool light = false;
};

/// One colour, shaded; or, where `light` is not empty, its radiance in the direction of each point's normal.
struct Ball {
  vec3 center{0};    ///< [m]
  float radius = 1;  ///< [m]
  vec3 color{1};
  sh::RadianceSh light = {};
};

/// A function of direction, Σ_k values[k] Y_k(ω), as the surface at distance scale · |value| from the centre,
/// coloured by sign and shaded.
struct Lobe {
  vec3 center{0};                  ///< [m]
  float scale = 1;                 ///< metres for a value of 1
  std::vector<float> values = {};  ///< in coefficient_index order, of one degree
  vec3 positive{0.0f, 0.165f, 0.45f}, negative{0.85f, 0.25f, 0.0f};
};

/// Largest magnitude of each lobe's function, on a grid of some 200 (degree + 1)² places. Throws Error for
/// values that are not those of a degree up to 10.
std::vector<float> largest_values(std::span<const Lobe> lobes);

struct Sketch {
  std::vector<Line> lines = {};
  std::vector<Disc> discs = {};
  std::vector<Box> boxes = {};
  std::vector<Ball> balls = {};
  std::vector<Lobe> lobes = {};

  bool empty() const { return size() == 0; }
  std::size_t size() const {
    return lines.size() + discs.size() + boxes.size() + balls.size() + lobes.size();
  }
  Sketch& operator+=(const Sketch& other);
};

}  // namespace ssphh::sketch
