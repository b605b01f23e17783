#pragma once

#include <ssphh/pipeline/render_scene.h>

namespace ssphh::python {

/// Throws Error for sizes and numbers of samples that no picture has.
void require_picture(const trace::RenderParams& params);

}  // namespace ssphh::python
