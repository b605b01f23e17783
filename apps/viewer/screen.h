#pragma once
/// What stands on the screen, and what of it is not that of now.

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/balls.h"
#include "model/edits.h"
#include "model/linear_picture.h"
#include "model/live_light.h"
#include "model/selection.h"
#include "model/settings.h"
#include "model/view_camera.h"

namespace ssphh::viewer {

/// What a picture was drawn with.
struct DrawnWith {
  View view;
  Settings settings;
  Selection selection;
  int width = 0, height = 0;
};

/// A picture that is being drawn, piece by piece.
struct Drawing {
  bool smooth = false;  ///< another one for the mean of a picture that stands still
  double seconds = 0;   ///< so far
};

/// A file that is to get the picture's linear light.
struct LinearFile {
  std::string file;
  bool begun = false;  ///< pictures are drawn for it
  LinearMean mean;     ///< of those of now
};

/// What marks over a picture hold for.
struct MarkedFor {
  int picture = 0;  ///< as Screen::pictures
  std::vector<methods::Drawing> draw;
  image::ToneMap tone;

  friend bool operator==(const MarkedFor&, const MarkedFor&) = default;
};

/// What histograms, waveform and false colours hold for.
struct ReadFor {
  int picture = 0, passes = 0;  ///< as Screen::pictures; of the truth, 0 where none is shown
  float exposure = 0;           ///< EV
  bool waveform = false, false_color = false;
  Show show = Show::realtime;
  float wipe = 0;

  friend bool operator==(const ReadFor&, const ReadFor&) = default;
};

/// The picture on the screen with what lies over and beside it. Each of them is drawn anew once it is not
/// that of now.
struct Screen {
  std::optional<DrawnWith> drawn;  ///< what the picture was drawn with; none: there is none
  std::optional<Drawing> drawing;  ///< the one that follows
  int pictures = 0;                ///< that became whole
  int first_place = 0;             ///< in its pixels, of the first in the mean, as place_in_pixel() counts
  int waiting_maps = 0;            ///< shadow maps that the picture still lacks
  std::optional<float> suits;      ///< EV that suits it, where it is to be followed
  bool is_new = true;              ///< the scene or its light: no picture shows it yet
  bool coarse = false;             ///< that, or something moves, and frames are slow: fewer pixels meanwhile

  std::optional<Ball> balls;                           ///< what the balls over it are coloured by
  std::optional<std::pair<DrawnWith, float>> outline;  ///< of what is selected, and when in the scene
  std::vector<unsigned char> visible;                  ///< per probe, from the eye
  std::optional<std::pair<View, float>> visible_from;  ///< and when in the scene `visible` holds
  std::optional<ReadFor> readings;
  std::optional<MarkedFor> marked;          ///< what the marks were asked for
  std::optional<Settings> truth_settings;   ///< that the truth was made for
  std::pair<std::string, int> truth_asked;  ///< method and depth of what is traced

  bool to_send = false;                   ///< the next picture is to be shown elsewhere, too
  std::optional<LinearFile> linear_file;  ///< none: nobody asked for one

  bool scene_dirty = true, balls_dirty = true, truth_dirty = true;

  /// What is drawn gives way to another view: one with something new is begun anew later.
  void drop_drawing() {
    if (awaits_picture()) drawn.reset();
    drawing.reset();
  }
  /// What lies over the picture of the view at work alone.
  void forget_beside() { readings.reset(), marked.reset(), truth_settings.reset(); }
  /// Whether a picture with something new is on its way.
  bool awaits_picture() const { return drawing && !drawing->smooth; }
  /// Another scene takes the place of the one that is shown.
  void forget() {
    drawn.reset(), drawing.reset(), outline.reset(), visible_from.reset(), readings.reset();
    marked.reset(), linear_file.reset();
    to_send = false;
    is_new = scene_dirty = true;
  }
};

/// What of the document the renderer and the light have by now.
struct Applied {
  std::shared_ptr<const scene::Scene> lamps_of;  ///< scene whose lamps the renderer has
  std::vector<scene::Material> materials;
  std::vector<SphlEdit> sphls;
  std::optional<Quality> quality, live_quality;  ///< of GEN's numbers, and that live light was asked for with
  bool bakes_again = false;                      ///< it was a bake that was stopped for that
  bool light_stale = false;  ///< places, surfaces or lamps are others than those that the light was found for
  double stale_since = 0;
  /// Scene with whose lamps live light was asked for last, and the light that did not have them.
  std::pair<std::shared_ptr<const scene::Scene>, const LiveLight*> relit_for{};

  void light_is_stale(double seconds) { light_stale = true, stale_since = seconds; }
};

}  // namespace ssphh::viewer
