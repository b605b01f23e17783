#include <ssphh/scene_io/renderer_export.h>

namespace ssphh::scene_io {

const std::vector<RendererFormat>& renderer_formats() {
  static const std::vector<RendererFormat> formats = {
      {"cycles", "Blender's Cycles: a Python script with the scene beside it", export_cycles},
  };
  return formats;
}

}  // namespace ssphh::scene_io
