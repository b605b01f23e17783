#version 450 core
// Mean of the samples of a pixel.
layout(binding = UNIT_PICTURE) uniform sampler2D image;
layout(location = 0) uniform int scale;
layout(location = 0) out vec4 color;
void main() {
  vec4 sum = vec4(0);
  ivec2 first = ivec2(gl_FragCoord.xy) * scale;
  for (int y = 0; y < scale; ++y) {
    for (int x = 0; x < scale; ++x) sum += texelFetch(image, first + ivec2(x, y), 0);
  }
  color = sum / float(scale * scale);
}
