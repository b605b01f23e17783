#pragma once
/// How the viewer shows a scene: plain values, each with a name that the command line, scripts and panels
/// share.

#include <functional>
#include <string>
#include <vector>

#include <ssphh/core/enum_names.h>
#include <ssphh/image/tonemap.h>
#include <ssphh/methods/drawing.h>
#include <ssphh/probes/hier.h>
#include <ssphh/probes/lookup.h>
#include <ssphh/rays/radiance_source.h>

#include "quality.h"

namespace ssphh::viewer {

/// What fills the picture.
enum class Show {
  realtime,
  truth,     ///< path traced, pass after pass
  wipe,      ///< real-time left of a line, truth right of it
  absolute,  ///< |real-time − truth|
  signed_,   ///< real-time − truth
  pixelated  ///< Σ|real-time − truth| over blocks, as the paper's figures
};
constexpr auto enum_table(Show) {
  using enum Show;
  return std::to_array<EnumName<Show>>({{realtime, "realtime"},
                                        {truth, "truth"},
                                        {wipe, "wipe"},
                                        {absolute, "absolute"},
                                        {signed_, "signed"},
                                        {pixelated, "pixelated"}});
}

/// What the real-time picture holds.
enum class DebugView { none, direct, indirect, albedo, normal, shadow, sphl, leak };
constexpr auto enum_table(DebugView) {
  using enum DebugView;
  return std::to_array<EnumName<DebugView>>({{none, "none"},
                                             {direct, "direct"},
                                             {indirect, "indirect"},
                                             {albedo, "albedo"},
                                             {normal, "normal"},
                                             {shadow, "shadow"},
                                             {sphl, "sphl"},
                                             {leak, "leak"}});
}

/// What colours a probe's ball.
enum class Ball {
  radiance,    ///< what the probe sees into each direction
  irradiance,  ///< what a surface there would get
  self,        ///< radiance of its own light alone
  neighbor,    ///< of the light that HIER adds
  sum
};
constexpr auto enum_table(Ball) {
  using enum Ball;
  return std::to_array<EnumName<Ball>>({{radiance, "radiance"},
                                        {irradiance, "irradiance"},
                                        {self, "self"},
                                        {neighbor, "neighbor"},
                                        {sum, "sum"}});
}

constexpr int most_views = 4;  ///< side by side

struct Settings {
  // Picture
  bool auto_exposure = true;  ///< `exposure` follows the picture
  float exposure = 0;         ///< EV
  image::ToneCurve curve = image::ToneCurve::filmic;
  Show show = Show::realtime;
  DebugView debug = DebugView::none;
  bool false_color = false, histogram = false, waveform = false;  ///< of light in stops
  bool antialias = true;                                          ///< while the picture stands still
  std::vector<methods::Drawing> draw;                             ///< what methods hold, over the picture
  float wipe = 0.5f;                                              ///< place of the line, share of the width
  int block = 16;                                                 ///< pixels, of `pixelated`
  std::string against =
      "path";  ///< what the truth's place holds: path, or a method of methods::all_methods()
  int truth_depth = rays::usual_max_depth;  ///< scattering events of the ground truth
  int truth_passes = 256;                   ///< samples per pixel
  int views = 1;                            ///< side by side, to most_views
  float scale = 1;         ///< pixels of the real-time picture per pixel of the window, along each axis
  int indirect_scale = 3;  ///< of the real-time picture where no truth is beside it

  // Probes' light
  Quality quality = Quality::window;  ///< of light that the window finds
  probes::LookupMethod lookup = probes::LookupMethod::irradiance;
  probes::WeightMethod weights = probes::WeightMethod::surface;  ///< of lookup `irradiance`
  probes::ProbeLayer layer = probes::ProbeLayer::sum;            ///< self where there is no hierarchy
  int degree = 4;                                                ///< bands kept by the lookup
  bool hier = false;                                             ///< HIER over the edges that the set has
  probes::HierParams hier_params{.op = probes::HierOperator::mean};

  // Probes on the screen
  bool balls = false, lobes = false, graph = false, names = false;
  Ball ball = Ball::radiance;
  float ball_size = 0;  ///< radius [m]; 0: as default_ball_size() has it

  // Handles in the picture
  bool snap = false;      ///< drags go in steps, and freely with Ctrl; else the other way round
  float snap_step = 0;    ///< [m]; 0: as suits the scene
  float snap_angle = 15;  ///< [degrees]

  // The scene's time
  bool play = false;
  float speed = 0.5f;  ///< seconds of the scene per second

  friend bool operator==(const Settings&, const Settings&) = default;
};

/// A setting by name, for command line and scripts.
struct SettingName {
  std::string name;   ///< "exposure"
  std::string group;  ///< "Picture"
  std::string help;
  std::vector<std::string> choices;  ///< empty: a number
  bool or_auto = false;              ///< beside a number the word auto
  /// Throws Error that says what would be right.
  std::function<void(Settings&, const std::string&)> set;
  std::function<std::string(const Settings&)> get;
};

const std::vector<SettingName>& setting_names();

/// Sets one by its name. Throws Error for an unknown name, which lists all, or a wrong value.
void set_setting(Settings& settings, const std::string& name, const std::string& value);

/// Parses a finite number; throws Error(where, …).
float number_of(const std::string& where, const std::string& text);

}  // namespace ssphh::viewer
