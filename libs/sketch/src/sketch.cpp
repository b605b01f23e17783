#include <ssphh/sketch/sketch.h>

namespace ssphh::sketch {

Sketch& Sketch::operator+=(const Sketch& other) {
  lines.insert(lines.end(), other.lines.begin(), other.lines.end());
  discs.insert(discs.end(), other.discs.begin(), other.discs.end());
  boxes.insert(boxes.end(), other.boxes.begin(), other.boxes.end());
  balls.insert(balls.end(), other.balls.begin(), other.balls.end());
  lobes.insert(lobes.end(), other.lobes.begin(), other.lobes.end());
  return *this;
}

}  // namespace ssphh::sketch
