#pragma once

#include "commands/render.h"

namespace ssphh::app {

/// `render --backend gl`: one frame of the real-time renderer, samples on a square grid. Throws Error for
/// options that it has no answer to.
RenderResult render_gl(const RenderOptions& o, const Control& control);

/// What both backends end with: writes the picture as the options say, and finds its mean.
void write_rendered(RenderResult& result, const RenderOptions& o);

}  // namespace ssphh::app
