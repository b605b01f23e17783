#pragma once
/// The user interface around the picture, one function per panel. Each reads the state and changes it through
/// App's functions; none keeps state of its own but what is being typed.

#include <cstddef>

namespace ssphh::viewer {

class App;

/// Menu, sidebar, time bar and messages; sets App::area and the views' places.
void draw_panels(App& app);
/// The picture behind them. Call when its textures are those of this frame.
void draw_picture(const App& app);

void draw_menu(App& app);
/// From `y` on, at the window's left; its width [pixels].
float draw_sidebar(App& app, float y, float height);
void draw_light_panel(App& app);
/// A part of it: the lamp that is selected.
void draw_lamp(App& app);
/// A part of that: where it stands and shines, and in which steps it is dragged.
void draw_lamp_place(App& app, std::size_t i);
/// Entries of a menu: a lamp of each kind to add.
void draw_lamp_kinds(App& app);
/// A part of it, of scenes with a computed sky.
void draw_sky(App& app);
void draw_probe_panel(App& app);
void draw_surface_panel(App& app);
void draw_scene_panel(App& app);
void draw_camera_panel(App& app);
void draw_picture_panel(App& app);
void draw_stats_panel(App& app);
/// Only where there is a farm.
void draw_farm_panel(App& app);
void draw_time_bar(App& app);
void draw_help(App& app);
/// Over the picture: the histogram, the waveform, and the legend of false colours,
/// in the part of the picture that nothing else covers.
void draw_readings(App& app, const Rect2& room);
/// What stands under the mouse, or at the pinned point, and what lights it, in that part, too; over the
/// legend where there is no room beside it.
void draw_inspector(App& app, const Rect2& room);
/// Lets the user choose the file of App::dialog, and opens or writes it.
void draw_file_dialog(App& app);
/// Asks App::question and takes the answer, by mouse or key.
void draw_question(App& app);

}  // namespace ssphh::viewer
