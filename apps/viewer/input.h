#pragma once
/// Mouse and keyboard in the picture.

namespace ssphh::viewer {

class App;

/// Moves the camera, picks and drags lamps and SPHLs, and does what keys ask for. `seconds` since the last
/// call.
void handle_input(App& app, float seconds);

/// A line of the help: what to press, what it does.
struct Shortcut {
  const char* keys;
  const char* what;
};
/// All of them, in the order of the help.
const Shortcut* shortcuts(int& count);

}  // namespace ssphh::viewer
