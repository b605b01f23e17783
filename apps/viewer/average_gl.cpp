#include "average_gl.h"

#include <utility>

#include <ssphh/gl/draw.h>
#include <ssphh/gl/program.h>
#include <ssphh/gl/vertex_array.h>

#include "whole_picture.h"

namespace ssphh::viewer {
namespace {

constexpr std::string_view add_shader = R"(#version 450 core
layout(binding = 0) uniform sampler2D picture;
layout(location = 0) out vec4 light;
void main() {
  vec3 c = texelFetch(picture, ivec2(gl_FragCoord.xy), 0).rgb;
  light = vec4(mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), step(0.04045, c)), 1.0);
}
)";

constexpr std::string_view mean_shader = R"(#version 450 core
layout(binding = 0) uniform sampler2D sum;
layout(location = 0) out vec4 color;
void main() {
  vec4 s = texelFetch(sum, ivec2(gl_FragCoord.xy), 0);
  vec3 c = clamp(s.rgb / s.a, 0.0, 1.0);
  color = vec4(mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c)), 1.0);
}
)";

const gl::ShaderFiles::Embedded average_sources[] = {
    {"whole.vert", whole_picture}, {"add.frag", add_shader}, {"mean.frag", mean_shader}};

/// Van der Corput's sequence.
float mirrored_digits(int i, int base) {
  float out = 0, share = 1;
  for (; i > 0; i /= base) {
    share /= static_cast<float>(base);
    out += share * static_cast<float>(i % base);
  }
  return out;
}

}  // namespace

struct AverageGl::Data {
  gl::Program add{gl::ShaderFiles(average_sources), "whole.vert", "add.frag"};
  gl::Program mean{gl::ShaderFiles(average_sources), "whole.vert", "mean.frag"};
  gl::VertexArray no_attributes;
  gl::Texture sum, shown;
  gl::Framebuffer sum_target, shown_target;

  void draw(const gl::Program& program, const gl::Texture& from, const gl::Framebuffer& to, gl::Blend blend) {
    gl::bind_framebuffer(to.id(), {0, 0, sum.width(), sum.height()});
    gl::apply({.blend = blend});
    no_attributes.bind();
    from.bind(0);
    program.use();
    gl::draw_triangles(3);
  }
};

AverageGl::AverageGl() : data_(std::make_unique<Data>()) {}
AverageGl::~AverageGl() = default;

void AverageGl::add(const gl::Texture& picture) {
  Data& d = *data_;
  if (picture.width() != d.sum.width() || picture.height() != d.sum.height()) {
    d.sum = gl::Texture(gl::Format::rgba32f, picture.width(), picture.height());
    d.shown = gl::Texture(gl::Format::rgba8, picture.width(), picture.height());
    d.shown.set_filter(true);
    const gl::Texture* const sum[] = {&d.sum};
    const gl::Texture* const shown[] = {&d.shown};
    d.sum_target = gl::Framebuffer(sum, nullptr), d.shown_target = gl::Framebuffer(shown, nullptr);
  }
  gl::apply_conventions();
  gl::Sampler::unbind(0);
  d.draw(d.add, picture, d.sum_target, count_ == 0 ? gl::Blend::off : gl::Blend::add);
  d.draw(d.mean, d.sum, d.shown_target, gl::Blend::off);
  ++count_;
}

gl::Texture AverageGl::take() {
  count_ = 0;
  data_->sum = {};
  return std::move(data_->shown);
}

const gl::Texture& AverageGl::mean() const {
  return data_->shown;
}

vec2 place_in_pixel(int i) {
  if (i == 0) return vec2(0);
  return vec2(mirrored_digits(i, 2), mirrored_digits(i, 3)) - 0.5f;
}

}  // namespace ssphh::viewer
