#pragma once
/// What a random scene is drawn with.

#include <array>

#include <ssphh/core/random.h>

#include "../house_parts.h"

namespace ssphh::scene {

/// Arguments of one call are evaluated in an order that compilers choose: no call has two that draw.
class Draw {
 public:
  /// Numbers of another `stream` change none of the usual ones.
  explicit Draw(int seed, std::uint64_t stream = 0x5ce4e5)
      : random_(static_cast<std::uint64_t>(seed), stream) {}
  float between(float least, float most) { return least + (most - least) * random_.uniform(); }
  /// Uniform in the logarithm.
  float scaled(float least, float most);
  /// A point of the box.
  vec3 within(const vec3& least, const vec3& most);
  /// 0 … count − 1.
  int pick(int count) { return static_cast<int>(random_.uniform() * static_cast<float>(count)); }
  bool chance(float probability) { return random_.uniform() < probability; }
  /// Plausible diffuse reflectance: grey, pale or saturated, 0.03 to 0.85.
  vec3 albedo();
  /// White to orange, largest component 1.
  vec3 lamp_color();

 private:
  Pcg32 random_;
};

enum class Daylight { none, sun_and_sky, sky, picture };

/// A scene in metres that is being drawn.
struct RandomScene {
  Draw draw;
  Draw glass;  ///< what is made of glass
  Builder b;
  Daylight daylight = Daylight::none;
  int lamps = 0;

  int matte() { return b.matte("matte", draw.albedo()); }
  /// Matte, glossy, metal or with a texture.
  int material();
  int textured(const vec3& even, const vec3& odd, float repeats);
  /// Textured, of colours that are drawn.
  int checkered(float repeats);
  /// As material(), or solid glass.
  int material_or_glass();
  /// Of a window: clear or tinted glass, or −1, none.
  int pane();
};

/// Sun and sky, an even sky, a coloured picture, or nothing.
void add_daylight(RandomScene& s, Daylight daylight);
/// A lamp of any kind that hangs or stands within the box, with light for `area` square metres.
void add_lamp(RandomScene& s, const vec3& least, const vec3& most, float area);
/// Something that stands on `foot`, within `size` of it, at most `height` tall.
void add_thing(RandomScene& s, const vec3& foot, float size, float height);

void add_flat(RandomScene& s);
void add_hall(RandomScene& s);
void add_street(RandomScene& s);
void add_tabletop(RandomScene& s);

}  // namespace ssphh::scene
