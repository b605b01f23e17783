#pragma once
/// Words on pictures.

#include <string_view>

#include <ssphh/image/image.h>

namespace ssphh::app {

/// Height of a line of text [pixels].
int label_height();

/// Writes words with their upper left corner at (x, y), in the font of the viewer; what does not fit into
/// [x, x + width) and into the picture is left out, characters beyond Latin-1 are question marks.
void write_label(image::Image& picture, int x, int y, int width, std::string_view text, const vec3& color);

}  // namespace ssphh::app
