#include <ssphh/scene_io/renderer_export.h>

namespace ssphh::scene_io {

const std::vector<RendererFormat>& renderer_formats() {
  static const std::vector<RendererFormat> formats = {
      {"cycles", "Blender's Cycles: a Python script with the scene beside it", export_cycles},
      {"mitsuba", "Mitsuba 3: scene.xml with PLY meshes", export_mitsuba},
      {"pbrt", "pbrt-v4: scene.pbrt with PLY meshes", export_pbrt},
      {"corona", "Corona Standalone, the paper's: scene.scn with scene.mtl, scene.conf and OBJ meshes",
       export_corona},
  };
  return formats;
}

}  // namespace ssphh::scene_io
