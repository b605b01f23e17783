#pragma once
/// `ssphh cubemap convert`: images of the whole sphere from one layout into another.

#include <string>

#include <ssphh/core/control.h>
#include <ssphh/core/json.h>
#include <ssphh/image/cube_layout.h>

namespace ssphh::app {

struct CubemapOptions {
  std::string input, output;  ///< image files: .exr .hdr .png .jpg
  image::Layout from = image::Layout::equirect, to = image::Layout::equirect;
  int size = 0;  ///< side of a face, height or diameter of the output, in pixels; 0: the input's resolution
};

struct CubemapResult {
  image::Image picture;  ///< as it was written, before the file's format rounds it
};

/// Converts and writes the image. Throws Error for an output of unknown extension (before anything else), for
/// files that cannot be read or written and for images whose size the layout cannot have; Cancelled when
/// asked to stop.
CubemapResult run_cubemap_convert(const CubemapOptions& options, const Control& control = {});

json::Value to_json(const CubemapResult& result, const CubemapOptions& options);
std::string to_text(const CubemapResult& result, const CubemapOptions& options);

}  // namespace ssphh::app
