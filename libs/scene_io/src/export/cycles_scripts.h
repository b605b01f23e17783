#pragma once

#include <span>
#include <string_view>

namespace ssphh::scene_io {

struct CyclesScript {
  const char* name;  ///< of the file
  std::string_view text;
};

/// The Python program render.py, which builds a scene in Blender from scene.json and scene.bin beside it and
/// renders it, and the modules that it imports from its own folder: the files of src/export/cycles, the same
/// for every scene, turned into strings when the library is built.
std::span<const CyclesScript> cycles_scripts();

}  // namespace ssphh::scene_io
