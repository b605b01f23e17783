#pragma once
/// The viewer's state, and what can be done with it. Panels, keys, scripts and the command line all call the
/// same functions.

#include <functional>
#include <memory>
#include <optional>

#include <ssphh/bake/bake.h>
#include <ssphh/gl/context.h>

#include "file_kinds.h"
#include "frame_export.h"
#include "model/autosave.h"
#include "model/camera_path.h"
#include "model/document.h"
#include "model/drag.h"
#include "model/exposure_follower.h"
#include "model/farm_client.h"
#include "model/file_dialog.h"
#include "model/file_watch.h"
#include "model/frame_times.h"
#include "model/inspection.h"
#include "model/marks.h"
#include "model/picture_sender.h"
#include "model/preferences.h"
#include "model/question.h"
#include "model/reading.h"
#include "model/reference.h"
#include "pane.h"
#include "probe_light.h"
#include "viewer.h"
#include "window.h"

namespace ssphh::viewer {

/// What all views share, and as its own pane the one at work: that which keys, mouse and panels act on.
class App : public Pane {
 public:
  App(Window& window, const ViewerOptions& options, LoadScene load, ShowElsewhere show = {});
  /// Work that is not saved, and that the user did not discard, is kept for the next session.
  ~App();
  App(const App&) = delete;
  App& operator=(const App&) = delete;

  /// One turn: takes over finished work, brings light and picture up to date, draws the window if anything
  /// changed. Returns the seconds that may be waited for input afterwards.
  double turn(const InjectedInput& input);

  /// Takes over what is done in the background; of what failed the user is told.
  void take_work();
  /// The same of marks; those that failed are switched off.
  void take_truth();
  void take_marks();
  /// Tells why a picture is not shown elsewhere.
  void take_shown();
  /// Takes over what the farm's broker told, if there is one; tells the user when it is lost, and back.
  void take_farm_news();

  // What can be done
  void open(const std::string& source);
  /// open(), and `then`. By hand a scene is loaded in the background, and what is open stays until that is
  /// done; it can be cancelled as any job.
  void open_then(const std::string& source, std::function<void()> then);
  /// open_then(), and light for the scene: as the option --probes has it unless that names a file; else of
  /// its SPHLs, if it has any, or by hand at places that are found.
  void open_lit(const std::string& source);
  /// What open_lit() does once the scene is there.
  void light_opened();
  /// Of many files the first scene is opened, or all that belongs to the open one; a folder is shown.
  void take_dropped(const std::vector<std::string>& files);
  /// As open_lit(), but asks before a scene takes the place of one with edits or of a bake that runs.
  void request_open(const std::string& source);
  /// Whether the window may go. Where edits or a bake would be lost it stays and the user is asked.
  bool may_close();
  void answer(Answer answer);
  /// What would be lost, for the user; empty: nothing, or nobody is there to be asked.
  std::string what_is_lost() const;
  /// Edits, or a bake, that no file has.
  bool unsaved() const { return document.dirty() || !light.unsaved().empty(); }
  /// Asks whether what an earlier session left shall be taken up: of the open scene, or of any where none is.
  void offer_recovery();
  void recover(const Kept& kept);
  /// Every minute in which something is not saved it is written to the folder of autosaves, in the
  /// background.
  void keep_unsaved();
  /// At once, as the end of the session does. Touches no window.
  void keep_at_once();
  /// Whether that is under way.
  bool keeping() const { return !keeper_.idle(); }
  /// Lets the user choose a file, at first in this folder; empty: in the scene's.
  void ask_for_file(FileDialog::For what, const std::filesystem::path& in = {});
  /// What is kept of the window beside scenes for the next session; where nobody sits nothing is.
  WindowLook look() const;
  void take_look();
  /// Writes it where it has changed, once nothing is being dragged.
  void keep_look();
  /// As for a scene, with the name of an overlay.
  void ask_for_overlay();
  /// What Enter does in the dialog: goes into a folder, or opens or writes the file. A file that is there is
  /// written over when it is chosen twice.
  void choose_file();
  /// Notes a scene among those that were opened recently, or takes it away.
  void remember_scene(const std::string& source, bool stays = true);
  /// Puts a document in the place of what is open; its renderer is the caller's business.
  void take_document(Document next);
  /// The scene, over the file where it was saved last; the first time to a new one in the current folder. The
  /// file that was opened stays as it is. A bake that is not saved becomes a probe file beside it; where only
  /// that is not saved, it alone.
  void save();
  /// As save_scene(). Throws Error for the file that was opened and overlays that lie on it.
  void save_as(const std::string& file);
  /// The scene, or its edits as an overlay, to this file, which is its own from then on.
  void save_scene(const std::string& file);
  void save_probes(const std::string& file);
  void save_path(const std::string& file);
  void load_path(const std::string& file);
  void save_stats(const std::string& file);
  /// PNG: the picture now, or the window after the next turn. EXR: linear light, once edges are smooth.
  void screenshot(const std::string& file, bool panels);
  /// Sends the picture's linear radiance, and that of a truth, to `show`. Throws Error where there is none.
  void show_elsewhere();
  void go_to_camera(const std::string& name);
  /// The view of now as a camera of the scene; an empty name becomes "view 1" or the next number.
  void save_camera(const std::string& name);
  /// The view of a bookmark, and its pose of the scene.
  void go_to(const CameraKey& key);
  void add_bookmark();
  /// Brings `inspection` up to date for a point of the picture.
  void inspect(const vec2& point);
  void toggle_inspector();
  /// Notes a view that somebody stays at, for view_back(). Every turn.
  void note_view();
  void view_back();
  void view_forward();
  /// What is looked at from another side; direction as seen_along().
  void view_along(const vec3& direction);
  void toggle_orthographic();
  /// Walks from the ground below the view on, or flies again; a turn's way to the right and forward, 1 at the
  /// walker's speed. Without a way it falls and climbs, too.
  void toggle_walk();
  void walk(const vec2& way, float seconds);
  /// As many views as the settings have, each in its place of the area.
  void arrange_views();
  /// The view at a point of the window becomes the one at work.
  void take_view_at(float x, float y);
  /// Frames what is selected, or everything, without going through a wall.
  void frame_selection();
  /// Selects, and tells what.
  void select(const Selection& selected);
  /// What the ray meets: a body and its material. Nothing there: nothing is selected.
  void select_on_ray(const rays::RayQuery& ray);
  /// Whether Picture::instead_texture() is what shows the real-time picture.
  bool shows_instead() const;
  /// The outline of what is selected, to lie over the picture; null: there is none.
  const gl::Texture* outline() const;
  /// As Document::edit(), and shows it.
  template <class Change>
  void edit(const std::string& what, const Change& change) {
    document.edit(what, change);
    redraw();
  }
  void undo();
  void redo();
  /// Probes at these places: the scene's (as edited), or found automatically, `spacing` 0 for some 150.
  void light_scene_probes();
  /// As the option --probes: off, scene, auto, auto:METRES or a file.
  void use_probes(const std::string& what);
  void place_probes(float spacing);
  /// Builds the light of the probes anew, in the background.
  void rebuild_light();
  /// GEN and VIZ of the SPHLs in the background, by the farm if there is one and it is used; probes appear
  /// one by one, at first as a glance finds them.
  void start_gen(bool viz_only);
  bool baking() const;
  /// From now on this machine does bakes, also the one that runs.
  void bake_here();
  /// A farm of this session's own whose broker or workers have ended.
  void restart_farm();
  /// Samples and faces of GEN as a quality has them, also where they were set by hand, and live light anew.
  void use_quality(Quality quality);
  bool quality_by_hand() const;
  /// To tell what a quality costs.
  LightKnown light_known() const;
  /// As probes::read_probe_keys() has them. By hand those of another scene are asked about, else refused, but
  /// where they are to be taken `anyway`.
  void take_probe_file(const std::string& file, bool anyway = false);
  /// Makes the surface records or fitted weights of the probes ready, in the background.
  void prepare_surfaces();
  void delete_selection();
  void add_sphl(const vec3& position);
  /// A lamp off the surface in the middle of the picture, or where the view's focus is; it is selected.
  void add_lamp(scene::LightType type);
  /// Adds a lamp and selects it.
  void add_lamp(LightEdit lamp);
  /// Another lamp like the selected one beside it, which is selected then.
  void duplicate_lamp();
  /// A picture of the sky around the scene, or with no name what it had. Throws Error where there is no
  /// scene.
  void take_surroundings(const std::string& file);
  /// Gives a lamp a photometric profile, or takes it with an empty one; the selected one that of a file. Both
  /// throw Error for lamps that can have none.
  void set_lamp_profile(std::size_t lamp, const scene::LampProfile& profile);
  void take_profile(const std::string& file);
  /// Whether the selected lamp shines in a direction.
  bool can_aim() const;
  /// Turns the selected lamp so that it shines at a point.
  void aim_at(const vec3& point);
  /// The same at what the ray meets; a sun shines from where the ray goes into the sky, or straight on the
  /// surface. False: there is nothing to aim at.
  bool aim_on_ray(const rays::RayQuery& ray);
  /// Turns the selected lamp in one undo step with what follows; any length but 0. Or gives it another pose.
  void turn_selected(const vec3& direction);
  void pose_selected(const mat4& world);
  /// Where the handle begins by which the selected lamp is aimed: the lamp, or of a sun the view's focus.
  std::optional<vec3> aim_origin() const;
  void say(const std::string& message);
  /// As say(), for what went wrong.
  void complain(const std::string& message);

  /// One frame's way of an automatic exposure toward what suits the picture on the screen, or at once to it;
  /// whether that changed it.
  bool follow_exposure();
  bool take_exposure();

  /// No background work, light and picture up to date, and ground truth complete where it is shown.
  bool current() const;
  /// current(), and edges as smooth as they get.
  bool settled() const;
  bool scene_open() const { return document.scene != nullptr; }
  /// The geometry for picking; null while the light is being built for the first time.
  const trace::TransportScene* picking() const { return picking_ ? picking_.get() : nullptr; }
  /// Something changed that the window must show.
  void redraw() { redraw_ = 3; }
  std::vector<std::string> camera_names() const;
  /// Of the scene, short: "rooms".
  std::string picture_name() const;
  /// Name of a new file in the current folder: "rooms-01.png".
  std::string free_file(const std::string& ending) const;
  /// Of the selected lamp or SPHL; none for other selections and for lamps without a place.
  std::optional<vec3> selected_position() const;
  void move_selected(const vec3& position);

  Window& window;
  const ViewerOptions& options;
  Document document;
  Settings settings;
  Selection selection;
  ProbeLight light;
  Reference reference;
  Marks marks;
  PictureSender elsewhere;
  BackgroundJob job;
  std::optional<FarmClient> farm;
  Preferences preferences;
  std::optional<FileDialog> dialog;
  std::filesystem::path replaces;  ///< file that save_button() writes over if pressed again
  FrameTimes times;
  realtime::FrameStats last_stats;
  std::optional<StopHistogram> histogram, truth_histogram;  ///< of the pictures that are shown
  std::optional<Waveform> waveform;                         ///< of the picture that is shown
  CameraPath bookmarks;
  std::optional<FrameExport> frames;  ///< of them, being drawn
  float path_time = 0;
  bool path_plays = false;
  bool panels = true, help = false, place_mode = false;
  bool aim_mode = false;  ///< the next click is what the selected lamp is aimed at
  bool inspecting = false;
  std::optional<vec2> pinned;            ///< point that is inspected; none: the one under the mouse
  std::optional<Inspection> inspection;  ///< of the point that was inspected last
  bool failures_end = false;       ///< work in the background that fails ends the session with its message
  bool follows_exposure = true;    ///< with every frame; else only where follow_exposure() is called
  std::string open_tab = "Light";  ///< of the sidebar
  float side_width = 0;            ///< of the sidebar, in heights of the text; 0: as suits the window
  std::vector<Pane> others;        ///< views beside the one at work
  Rect2 area;                      ///< of the window, where all views are
  Drag drag;
  Question question;
  std::string message;
  bool message_is_error = false;
  double message_since = 0;  ///< of Window::seconds(), as the members below
  bake::BakeParams bake_params;
  ViewerReport report;
  float fly_speed = 2;  ///< m/s

 private:
  struct Loaded;
  void take_loaded(const std::string& source, Loaded loaded);
  void take_scene(std::string source, scene::Scene scene);
  void take_scene(Loaded loaded);
  void take_document(Loaded loaded);
  void watch_file();
  /// start_view(), or of a scene without cameras study::default_view().
  View view_from(const std::string& camera) const;
  /// Notes a file that was written and says so.
  void written(const std::string& verb, const std::string& file);
  /// SPHLs at these places of probes, which light has been or will be found for, in place of all there were.
  template <class Places>
  void take_places(const std::string& what, const Places& places);
  /// The selected SPHL or lamp is the same one as in `before`, if it is still there.
  void keep_selection(const Edits& before);
  void delete_lamp();
  /// Why a set is not of the scene; empty: it is. The other throws Error then, or warns.
  std::string misfit(const probes::ProbeSet& set) const;
  void fit_to_scene(probes::ProbeSet& set, const std::string& file, bool anyway) const;
  /// By the quality that is set, which live light has from then on.
  LiveLightParams light_params();
  void start_light(const std::string& name, const LiveLightParams& params,
                   const std::function<void(const LiveLight&)>& placed);
  void take_quality();
  void update_time(double seconds);
  void apply_edits();
  /// The lamps that there are now, to the renderer.
  void apply_lamps();
  void stop_stale_bake();
  void update_light();
  void finish_frame();
  void update_title();
  bool by_hand() const, holds_slider() const;
  void leave();
  bool keeps() const { return autosave_.keeps() && by_hand(); }

  // The picture (app_picture.cpp)
  void resize_picture();
  bool picture_stale() const;
  void draw_scene();
  /// The views' pictures in turns: that of the view at work first, then the others', then smooth edges.
  void draw_pictures();
  /// Begins or continues the pane's picture, or one for its smooth edges; whether there was something to do.
  bool work_on_picture(bool smooth);
  void begin_drawing(const Drawing& drawing, const realtime::FrameSettings& how);
  void draw_views();
  void begin_picture();
  void continue_picture();
  bool show_tone_again();
  void finish_picture(const Drawing& done);
  void show_finished();
  void draw_balls();
  void draw_outline();
  /// Brings histograms, waveform and false colours up to date with the picture.
  void update_readings();
  void update_truth();
  /// Marks are drawn over a picture once it is whole.
  void update_marks();
  bool draws_marks() const { return !settings.draw.empty() && !settings.false_color; }
  bool marked() const;
  MarkedFor marks_key() const;
  /// What methods may stand on: the geometry knows nodes of the scene as opened, edits may bring others;
  /// null: they build their own.
  trace::SharedGeometry geometry_of_methods(const scene::Scene& edited) const;
  /// Writes the picture's light, or sends the picture elsewhere, if that was asked for and it is there.
  void write_linear();
  void send_picture();
  void send_truth();
  void update_visible();
  std::optional<float> suitable_exposure() const;
  bool smooths() const {
    return settings.antialias && !needs_truth(settings) && !settings.false_color && !draws_marks();
  }
  bool reads() const { return settings.histogram || settings.waveform || settings.false_color; }
  bool wants_linear() const {
    return !beside && (needs_truth(settings) || inspecting || reads() || draws_marks() || screen.to_send);
  }

  LoadScene load_;
  std::optional<gl::Context> gl_;  ///< adopted with the first scene
  std::unique_ptr<realtime::Renderer> renderer_;
  std::unique_ptr<BallsGl> balls_;
  trace::SharedGeometry geometry_;  ///< of document.opened, and of every scene with other lamps
  std::unique_ptr<trace::TransportScene> picking_;
  Applied applied_;
  int rendered_ = 0;  ///< place of the view whose frame the renderer has
  struct Baked {
    bool viz_only = false;
    Edits edits;
  };
  std::optional<Baked> baked_;  ///< what the last bake was started with
  std::string farm_failure_;    ///< that was told last
  double gen_rate_ = 0;         ///< paths per second of the last GEN with VIZ; 0: there was none
  double live_seconds_ = 0;     ///< that the live light of now took
  ExposureFollower exposure_;
  std::optional<InspectedAt> inspected_;  ///< what `inspection` holds for
  scene::Bounds clicked_;                 ///< part of the selected object that was clicked; empty: it was not

  FileWatch watch_;                   ///< of the scene's file
  std::optional<FileDialog> mended_;  ///< comes back if what was chosen there cannot be loaded
  WindowLook kept_look_;              ///< in the preferences
  Autosave autosave_;
  BackgroundJob keeper_;                       ///< writes what is not saved
  std::pair<std::uint64_t, int> kept_{0, -1};  ///< History::serial() and ProbeLight::works() of what was kept
  std::optional<double> unsaved_since_;        ///< or since it was kept
  bool closes_ = false;                        ///< the user does not mind what is lost

  std::string title_;
  std::string window_shot_;  ///< file that is to get the window's next frame; empty: none
  int redraw_ = 3;
  double last_turn_ = 0, last_change_ = 0, last_frame_ = 0;
};

}  // namespace ssphh::viewer
