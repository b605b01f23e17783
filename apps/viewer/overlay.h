#pragma once
/// Lines and signs over the picture: lamps, the hierarchy's graph, names, handles, the wipe's line.

#include <vector>

namespace ssphh::viewer {

class App;

/// `visible` per probe: whether the eye sees it.
void draw_overlay(const App& app, const std::vector<unsigned char>& visible);

/// Light whose sign is under a point of the window; −1: none.
int lamp_under_mouse(const App& app, float x, float y);
/// Axis of the selection's handle there, 0..2; −1: none.
int axis_under_mouse(const App& app, float x, float y);

/// Metres from the selected lamp to the handle of its direction.
float aim_length(const App& app);
/// Whether that handle is under a point of the window.
bool aim_under_mouse(const App& app, float x, float y);

/// Probes are the enabled SPHLs in their order. −1: none.
int probe_of_sphl(const App& app, int sphl);
int sphl_of_probe(const App& app, int probe);

}  // namespace ssphh::viewer
