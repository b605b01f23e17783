#include "balls_gl.h"

#include <algorithm>
#include <cmath>

#include <ssphh/gl/buffer.h>
#include <ssphh/gl/draw.h>
#include <ssphh/gl/framebuffer.h>
#include <ssphh/gl/program.h>
#include <ssphh/gl/vertex_array.h>

namespace ssphh::viewer {
namespace {

constexpr std::string_view vertex_shader = R"(#version 450 core
layout(std430, binding = 0) readonly buffer Colors { vec4 colors[]; };    // [probe][vertex]
layout(std430, binding = 1) readonly buffer Shape { vec4 directions[]; };  // of the mesh
layout(std430, binding = 2) readonly buffer Corners { uint corners[]; };
layout(std430, binding = 3) readonly buffer Shown { vec4 shown[]; };  // position, radius; one for each probe
uniform mat4 world_to_clip;
uniform float lobes;
uniform int vertex_count;
uniform int corner_count;
uniform int selected;
out vec3 radiance;
out vec3 normal;
out vec3 place_seen;
flat out int chosen;
void main() {
  int probe = gl_VertexID / corner_count;
  vec4 place = shown[probe];
  uint corner = corners[gl_VertexID % corner_count];
  vec4 color = colors[probe * vertex_count + int(corner)];
  vec3 direction = directions[corner].xyz;
  radiance = color.rgb;
  normal = direction;
  chosen = probe == selected ? 1 : 0;
  // color.a: luminance in this direction, the probe's brightest being 1.
  float r = place.w * (chosen == 1 ? 1.25 : 1.0) * mix(1.0, 0.25 + 1.5 * color.a, lobes);
  place_seen = place.xyz + r * direction;
  gl_Position = world_to_clip * vec4(place_seen, 1.0);
}
)";

constexpr std::string_view fragment_shader = R"(#version 450 core
in vec3 radiance;
in vec3 normal;
in vec3 place_seen;
flat in int chosen;
uniform float exposure;
uniform float gamma;
uniform int filmic;
uniform vec3 eye;
uniform int behind;  // 1: what surfaces hide, faint; 0: what they do not
uniform vec2 depth_scale;
layout(binding = 0) uniform sampler2D scene_depth;
layout(location = 0) out vec4 color;
void main() {
  // Nearer is greater
  float surface = texelFetch(scene_depth, ivec2(gl_FragCoord.xy * depth_scale), 0).x;
  if ((gl_FragCoord.z < surface) != (behind == 1)) discard;
  vec3 c = radiance * exposure;
  c = filmic == 1 ? c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14) : c;
  c = clamp(c, 0.0, 1.0);
  c = gamma > 0.0 ? pow(c, vec3(1.0 / gamma))
                  : mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
  // A rim keeps balls apart from a wall of their own colour.
  float facing = abs(dot(normalize(normal), normalize(eye - place_seen)));
  vec3 rim = chosen == 1 ? vec3(1.0, 0.75, 0.3) : vec3(0.08);
  color = vec4(mix(rim, c, smoothstep(0.15, chosen == 1 ? 0.6 : 0.4, facing)),
               behind == 0 ? 1.0 : chosen == 1 ? 0.5 : 0.12);
}
)";

const gl::ShaderFiles::Embedded sources[] = {{"balls.vert", vertex_shader}, {"balls.frag", fragment_shader}};

}  // namespace

struct BallsGl::Data {
  gl::Program program{gl::ShaderFiles(sources), "balls.vert", "balls.frag"};
  gl::VertexArray no_attributes;
  std::unique_ptr<BallShader> shader;
  int levels = -1, corner_count = 0;
  gl::Buffer colors, shape, corners, shown;
  std::vector<vec3> radiance;
  std::vector<vec4> values, places;

  void set_levels(int wanted) {
    if (levels == wanted) return;
    levels = wanted;
    shader = std::make_unique<BallShader>(make_ball(levels));
    std::vector<vec4> directions;
    for (const vec3& v : shader->mesh().vertices) directions.emplace_back(v, 0);
    const std::vector<uvec3>& triangles = shader->mesh().triangles;
    shape = gl::Buffer(std::span<const vec4>(directions));
    corners = gl::Buffer(std::span<const uvec3>(triangles));
    corner_count = static_cast<int>(3 * triangles.size());
  }
};

BallsGl::BallsGl() : data_(std::make_unique<Data>()) {}
BallsGl::~BallsGl() = default;

void BallsGl::update(const probes::ProbeSet& set, Ball ball) {
  Data& d = *data_;
  const std::size_t probes = set.probes.size();
  d.set_levels(ball_levels(probes));
  const std::size_t vertices = d.shader->mesh().vertices.size();
  d.radiance.resize(vertices);
  d.values.resize(probes * vertices);
  for (std::size_t i = 0; i < probes; ++i) {
    d.shader->shade(set, i, ball, d.radiance);
    float brightest = 1e-20f;
    for (const vec3& c : d.radiance) brightest = std::max(brightest, luminance(c));
    for (std::size_t v = 0; v < vertices; ++v)
      d.values[i * vertices + v] = vec4(d.radiance[v], luminance(d.radiance[v]) / brightest);
  }
  d.colors.reserve(d.values.size() * sizeof(vec4));
  d.colors.update(std::span<const vec4>(d.values));
}

void BallsGl::draw(const probes::ProbeSet& set, const Look& look, const Behind& frame, unsigned framebuffer,
                   int width, int height) {
  Data& d = *data_;
  d.places.clear();
  for (const probes::Probe& probe : set.probes)
    d.places.emplace_back(probe.position, seen_ball_size(look.radius, look.view, probe.position));
  if (d.places.empty() || d.values.empty()) return;
  d.shown.reserve(d.places.size() * sizeof(vec4));
  d.shown.update(std::span<const vec4>(d.places));

  gl::bind_framebuffer(framebuffer, {0, 0, width, height});
  gl::apply_conventions();
  gl::apply({.depth = gl::Depth::test_and_write});
  gl::clear_depth({0, 0, width, height}, 0);
  d.no_attributes.bind();
  d.colors.bind_storage(0);
  d.shape.bind_storage(1);
  d.corners.bind_storage(2);
  d.shown.bind_storage(3);
  d.program.use();
  d.program.set("world_to_clip", frame.view_projection);
  d.program.set("depth_scale", vec2(frame.depth.width(), frame.depth.height()) / vec2(width, height));
  d.program.set("lobes", look.lobes ? 1.0f : 0.0f);
  d.program.set("vertex_count", static_cast<int>(d.shader->mesh().vertices.size()));
  d.program.set("corner_count", d.corner_count);
  d.program.set("selected", look.selected);
  d.program.set("exposure", std::exp2(look.tone.exposure));
  d.program.set("gamma", look.tone.gamma);
  d.program.set("filmic", look.tone.curve == image::ToneCurve::filmic ? 1 : 0);
  d.program.set("eye", look.view.eye);
  frame.depth.bind(0);
  for (const bool behind : {false, true}) {
    gl::apply({.depth = gl::Depth::test_and_write,
               .blend = behind ? gl::Blend::over : gl::Blend::off,
               .cull = gl::Cull::back});
    d.program.set("behind", behind ? 1 : 0);
    gl::draw_triangles(d.corner_count * static_cast<int>(d.places.size()));
  }
}

}  // namespace ssphh::viewer
