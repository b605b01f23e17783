#pragma once

#include "commands/command.h"
#include "options/render_options.h"

namespace ssphh::app {

/// `render --backend gl`: one frame of the real-time renderer, samples on a square grid. Throws Error for
/// options that it has no answer to.
void render_gl(const RenderOptions& o, const Context& context);

}  // namespace ssphh::app
