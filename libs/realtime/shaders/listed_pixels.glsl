// Pixels whose indirect light could not be interpolated, in any order; mirrors ListedPixels in gpu_types.h. A compute
// shader takes them in groups, and rows of groups: few pixels, wherever they lie, fill whole vectors.
const uint LISTED_GROUP = 64u, LISTED_ROW = 1024u;
layout(std430, binding = BINDING_LISTED_PIXELS) buffer ListedPixels {
  uint groups_x, groups_y, groups_z;  // as a dispatch takes them
  uint count;
  uint pixels[];  // x, y << 16
} listed;
