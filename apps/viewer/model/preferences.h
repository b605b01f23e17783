#pragma once
/// What the viewer remembers from one session to the next, as preferences.json keeps it.

#include <filesystem>
#include <string>
#include <vector>

#include "quality.h"

namespace ssphh::viewer {

/// How the window was left.
struct WindowLook {
  float side_width = 0;  ///< of the panels, in heights of the text; 0: as suits the window
  bool histogram = false, waveform = false, false_color = false;
  Quality quality = Quality::window;  ///< of light that the window finds
  bool snap = false;                  ///< drags go in steps
  float snap_angle = 15;              ///< [degrees]

  friend bool operator==(const WindowLook&, const WindowLook&) = default;
};

struct Preferences {
  std::vector<std::string>
      recent;  ///< scenes that were opened or saved, by lasting_name(), the last one first
  WindowLook look{};

  static constexpr std::size_t most_recent = 12;
};

/// The name of a scene in every folder: absolute paths of files, builtin:NAME as it is.
std::string lasting_name(const std::string& source);

/// Defaults where there is no such file. Throws Error for one that is broken or of another version.
Preferences read_preferences(const std::filesystem::path& file);
/// Makes the folder, too. Throws Error as write_file() does.
void write_preferences(const Preferences& preferences, const std::filesystem::path& file);

/// Puts a scene in front, once, and forgets the oldest beyond `most_recent`; or takes it away.
void remember(Preferences& preferences, const std::string& source);
void forget(Preferences& preferences, const std::string& source);

}  // namespace ssphh::viewer
