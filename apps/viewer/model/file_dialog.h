#pragma once

#include <filesystem>
#include <string>

#include "file_browser.h"

namespace ssphh::viewer {

/// A file that the user is about to choose.
struct FileDialog {
  enum class For { open, scene, probes, profile, picture, sky } what = For::open;
  FileBrowser browser;
  bool reads() const { return what == For::open || what == For::profile || what == For::sky; }
  std::string problem;             ///< with what was chosen last
  std::filesystem::path replaces;  ///< file that is there, and is written over once it is chosen again
};

}  // namespace ssphh::viewer
