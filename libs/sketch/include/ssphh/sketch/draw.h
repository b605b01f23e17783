#pragma once
/// Draws a sketch over a picture, on the CPU, for every projection alike: it asks for the rays of pixels.

#include <functional>
#include <span>

#include <ssphh/core/control.h>
#include <ssphh/image/image.h>
#include <ssphh/sketch/sketch.h>

namespace ssphh::sketch {

struct Ray {
  vec3 origin{0}, direction{0, 0, -1};  ///< [m]; unit
};

/// How the picture looks at space.
struct Eye {
  /// Of a place on the picture [pixels] from the upper left. Rays start at one point or are all parallel.
  std::function<Ray(float x, float y)> ray;
  /// Metres along each ray to what hides the sketch, infinite where nothing does; none: nothing ever does.
  std::function<void(std::span<const Ray> rays, std::span<float> distances)> surfaces = {};
};

struct DrawParams {
  float white = 1;  ///< radiance that the picture shows as 1 [W sr⁻¹ m⁻²]: what a colour of 1 is drawn as
  float hidden = 0.25f;  ///< opacity of what surfaces hide; that of all else is 1
  int samples = 4;       ///< along each edge of a pixel
};

/// Of the sketch's marks the nearest is seen. A mark around the eye is left out. The same bits for any number
/// of threads. Throws Error for a picture that is not RGB, for no ray, for numbers of samples outside 1..16
/// and for lobes that are not of one degree up to 10; Cancelled.
void draw(image::Image& picture, const Sketch& sketch, const Eye& eye, const DrawParams& params = {},
          const Control& control = {});

}  // namespace ssphh::sketch
