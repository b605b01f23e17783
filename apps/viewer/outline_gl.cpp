#include "outline_gl.h"

#include <map>

#include <ssphh/gl/buffer.h>
#include <ssphh/gl/draw.h>
#include <ssphh/gl/framebuffer.h>
#include <ssphh/gl/program.h>
#include <ssphh/gl/vertex_array.h>

#include "whole_picture.h"

namespace ssphh::viewer {
namespace {

constexpr std::string_view body_vertex = R"(#version 450 core
layout(location = 0) in vec3 position;
uniform mat4 to_clip;
void main() { gl_Position = to_clip * vec4(position, 1.0); }
)";

constexpr std::string_view body_fragment = R"(#version 450 core
layout(binding = 0) uniform sampler2D scene_depth;
uniform vec2 depth_scale;
layout(location = 0) out vec4 mask;
void main() {
  // Nearer is greater; the frame drew the same triangles by other sums.
  float surface = texelFetch(scene_depth, ivec2(gl_FragCoord.xy * depth_scale), 0).x;
  mask = vec4(1.0, gl_FragCoord.z * 1.001 >= surface ? 1.0 : 0.0, 0.0, 1.0);
}
)";

constexpr std::string_view line_fragment = R"(#version 450 core
layout(binding = 0) uniform sampler2D mask;
layout(location = 0) out vec4 color;
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy), last = textureSize(mask, 0) - 1;
  bool inside = texelFetch(mask, at, 0).x > 0.5, beside = false, seen = false;
  for (int y = -2; y <= 2; ++y) {
    for (int x = -2; x <= 2; ++x) {
      if (x * x + y * y > 5) continue;
      vec2 m = texelFetch(mask, clamp(at + ivec2(x, y), ivec2(0), last), 0).xy;
      beside = beside || m.x > 0.5;
      seen = seen || m.y > 0.5;
    }
  }
  color = !inside && beside ? vec4(1.0, 0.75, 0.31, seen ? 1.0 : 0.45) : vec4(0.0);
}
)";

const gl::ShaderFiles::Embedded outline_sources[] = {{"body.vert", body_vertex},
                                                     {"body.frag", body_fragment},
                                                     {"line.vert", whole_picture},
                                                     {"line.frag", line_fragment}};

}  // namespace

struct OutlineGl::Data {
  struct Mesh {
    gl::Buffer positions, triangles;
    gl::VertexArray array;
    int corners = 0;

    explicit Mesh(const scene::Mesh& mesh)
        : positions(std::span<const vec3>(mesh.positions)),
          triangles(std::span<const uvec3>(mesh.triangles)),
          corners(static_cast<int>(3 * mesh.triangles.size())) {
      array.attribute(0, {positions.id(), 0, sizeof(vec3)}, 3);
      array.indices(triangles.id());
    }
  };
  struct Body {
    const Mesh* mesh;
    int node;
  };

  gl::Program bodies_program{gl::ShaderFiles(outline_sources), "body.vert", "body.frag"};
  gl::Program line_program{gl::ShaderFiles(outline_sources), "line.vert", "line.frag"};
  gl::VertexArray no_attributes;
  std::map<int, Mesh> meshes;
  std::vector<Body> bodies;
  gl::Texture mask, line;
  gl::Framebuffer mask_target, line_target;

  void resize(int width, int height) {
    if (mask.width() == width && mask.height() == height) return;
    mask = gl::Texture(gl::Format::rgba8, width, height);
    line = gl::Texture(gl::Format::rgba8, width, height);
    line.set_filter(true);
    const gl::Texture* const masks[] = {&mask};
    const gl::Texture* const lines[] = {&line};
    mask_target = gl::Framebuffer(masks, nullptr), line_target = gl::Framebuffer(lines, nullptr);
  }
};

OutlineGl::OutlineGl() : data_(std::make_unique<Data>()) {}
OutlineGl::~OutlineGl() = default;

bool OutlineGl::empty() const {
  return data_->bodies.empty();
}

void OutlineGl::set(const scene::Scene& scene, const std::vector<int>& instances) {
  Data& d = *data_;
  d.bodies.clear();
  d.meshes.clear();
  for (const int i : instances) {
    const scene::Instance& instance = scene.instances[i];
    const scene::Mesh& mesh = scene.meshes[instance.mesh];
    if (mesh.triangles.empty()) continue;
    d.bodies.push_back({&d.meshes.try_emplace(instance.mesh, mesh).first->second, instance.node});
  }
}

void OutlineGl::draw(const std::vector<mat4>& world, const gl::Texture& depth, const mat4& view_projection,
                     int width, int height) {
  Data& d = *data_;
  d.resize(width, height);
  gl::apply_conventions();
  gl::Sampler::unbind(0);
  const gl::Rect whole{0, 0, width, height};
  gl::bind_framebuffer(d.mask_target.id(), whole);
  gl::clear_color(0, 0, 0, 0, 0);
  // Whatever covers a pixel, and whether any of it is seen
  gl::apply({.blend = gl::Blend::add});
  depth.bind(0);
  d.bodies_program.use();
  d.bodies_program.set("depth_scale", vec2(depth.width(), depth.height()) / vec2(width, height));
  for (const Data::Body& body : d.bodies) {
    d.bodies_program.set("to_clip", view_projection * world[body.node]);
    body.mesh->array.bind();
    gl::draw_indexed(body.mesh->corners, 0, 0);
  }
  gl::bind_framebuffer(d.line_target.id(), whole);
  gl::apply({});
  d.no_attributes.bind();
  d.mask.bind(0);
  d.line_program.use();
  gl::draw_triangles(3);
}

const gl::Texture& OutlineGl::picture() const {
  return data_->line;
}

}  // namespace ssphh::viewer
