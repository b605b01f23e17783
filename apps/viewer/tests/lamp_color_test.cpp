// Colours of lamps as hexadecimal sRGB and as temperatures, and the rows that take them.

#include "model/lamp_color.h"

#include <gmock/gmock.h>

#include "panel_stage.h"

namespace ssphh::viewer {
namespace {

TEST(LampColor, IsTheSrgbOfItsDigits) {
  // IEC 61966-2-1: 188 is the byte of half the light.
  EXPECT_EQ(hex_of(vec3(0.5f, 0, 1)), "#bc00ff");
  const vec3 half = color_of_hex("#BC00ff").value();
  EXPECT_NEAR(half.x, 0.5029f, 1e-4f);
  EXPECT_EQ(half.y, 0);
  EXPECT_NEAR(half.z, 1, 1e-6f);
  EXPECT_EQ(color_of_hex("fe0"), color_of_hex("#ffee00"));
  for (int v = 0; v < 256; ++v) {
    const std::string text = fmt::format("#{:02x}{:02x}{:02x}", v, 255 - v, v / 2);
    EXPECT_EQ(hex_of(color_of_hex(text).value()), text);
  }
  EXPECT_EQ(hex_of(vec3(7, -1, 0)), "#ff0000");
  for (const char* bad : {"", "#", "#12", "#1234567", "#12345g", "red"})
    EXPECT_FALSE(color_of_hex(bad)) << bad;
}

/// Chromaticities of black bodies by Planck's law and the 1931 observer (Wyszecki & Stiles, Color Science).
TEST(LampColor, OfATemperatureIsThatOfABlackBody) {
  struct Known {
    float kelvin, x, y;
  };
  for (const Known& known : {Known{2856, 0.4476f, 0.4074f},
                             {5000, 0.3451f, 0.3516f},
                             {6500, 0.3135f, 0.3236f},
                             {10000, 0.2807f, 0.2884f}}) {
    const vec3 c = color_of_kelvin(known.kelvin);
    EXPECT_EQ(std::max({c.x, c.y, c.z}), 1) << known.kelvin;
    const float x = 0.4124564f * c.x + 0.3575761f * c.y + 0.1804375f * c.z,
                y = 0.2126729f * c.x + 0.7151522f * c.y + 0.0721750f * c.z,
                z = 0.0193339f * c.x + 0.1191920f * c.y + 0.9503041f * c.z;
    EXPECT_NEAR(x / (x + y + z), known.x, 0.001f) << known.kelvin;
    EXPECT_NEAR(y / (x + y + z), known.y, 0.001f) << known.kelvin;
    EXPECT_NEAR(kelvin_of(c).value(), known.kelvin, 0.02f * known.kelvin) << "and back";
  }
  EXPECT_FALSE(kelvin_of(vec3(0)));
  EXPECT_EQ(kelvin_of(vec3(0, 0, 1)).value(), most_kelvin);
}

using LampColorRows = PanelStage;

TEST_F(LampColorRows, TakeDigitsAndTemperatures) {
  app().selection = {Kind::light, 1};
  open("Light");
  const auto color = [&] { return app().document.edits().lights[1].color; };
  const vec3 before = color();
  const DrawnThing field = widget("sRGB");
  click(field.from.x + 8, field.from.y + 8);
  window_->typed = "#ff8000";
  frames(2);
  press({GLFW_KEY_ENTER});
  rest();
  EXPECT_EQ(color(), color_of_hex("#ff8000").value());
  EXPECT_EQ(app().document.history.undo_name(), "colour spot");
  EXPECT_TRUE(app().document.history.undo());
  EXPECT_EQ(color(), before) << "one step";
  pull("temperature", -40);
  const vec3 warm = color();
  EXPECT_GT(warm.x, warm.z);
  pull("temperature", 4000);
  EXPECT_EQ(color(), color_of_kelvin(most_kelvin));
  EXPECT_TRUE(app().document.history.undo());
  EXPECT_EQ(color(), warm);
}

}  // namespace
}  // namespace ssphh::viewer
