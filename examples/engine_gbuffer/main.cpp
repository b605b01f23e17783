// An engine with a renderer of its own: draws depth and normals by plain OpenGL, has indirect light found on
// them, and goes on.

#include <cstdio>

#include <epoxy/gl.h>
#include <glm/gtc/matrix_transform.hpp>

#include <ssphh/bake/bake.h>
#include <ssphh/place/init.h>
#include <ssphh/realtime/renderer.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/trace/path_tracer.h>

using namespace ssphh;

namespace {

constexpr int width = 160, height = 90;

// What an engine has anyway: its mesh, its program, its framebuffer.
class Engine {
 public:
  explicit Engine(const scene::Scene& scene) {
    const std::vector<mat4> world = scene::world_matrices(scene, 0);
    for (const scene::Instance& instance : scene.instances) {
      const scene::Mesh& mesh = scene.meshes[instance.mesh];
      const mat4& place = world[instance.node];
      for (const auto& triangle : mesh.triangles) {
        vec3 p[3];
        for (int i = 0; i < 3; ++i) p[i] = vec3(place * vec4(mesh.positions[triangle[i]], 1));
        const vec3 normal = glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0]));
        for (const vec3& corner : p) vertices_.insert(vertices_.end(), {corner, normal});
      }
    }
    glCreateBuffers(1, &buffer_);
    glNamedBufferStorage(buffer_, static_cast<GLsizeiptr>(vertices_.size() * sizeof(vec3)), vertices_.data(),
                         0);
    glCreateVertexArrays(1, &mesh_);
    glVertexArrayVertexBuffer(mesh_, 0, buffer_, 0, 2 * sizeof(vec3));
    for (GLuint i = 0; i < 2; ++i) {
      glEnableVertexArrayAttrib(mesh_, i);
      glVertexArrayAttribFormat(mesh_, i, 3, GL_FLOAT, GL_FALSE, static_cast<GLuint>(i * sizeof(vec3)));
      glVertexArrayAttribBinding(mesh_, i, 0);
    }
    program_ = glCreateProgram();
    attach(GL_VERTEX_SHADER,
           "#version 450\nlayout(location = 0) in vec3 p; layout(location = 1) in vec3 n; out vec3 normal;\n"
           "layout(location = 0) uniform mat4 m; void main() { gl_Position = m * vec4(p, 1); normal = n; }");
    attach(
        GL_FRAGMENT_SHADER,
        "#version 450\nin vec3 normal; out vec4 color; void main() { color = vec4(0.5 + 0.5 * normal, 1); }");
    glLinkProgram(program_);
    glCreateTextures(GL_TEXTURE_2D, 2, textures_);
    glTextureStorage2D(textures_[0], 1, GL_DEPTH_COMPONENT24, width, height);
    glTextureStorage2D(textures_[1], 1, GL_RGB10_A2, width, height);
    glCreateFramebuffers(1, &framebuffer_);
    glNamedFramebufferTexture(framebuffer_, GL_DEPTH_ATTACHMENT, textures_[0], 0);
    glNamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, textures_[1], 0);
  }

  void draw(const mat4& view_projection) const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    glViewport(0, 0, width, height);
    glEnable(GL_DEPTH_TEST);
    glClear(GL_DEPTH_BUFFER_BIT | GL_COLOR_BUFFER_BIT);
    glUseProgram(program_);
    glUniformMatrix4fv(0, 1, GL_FALSE, &view_projection[0].x);
    glBindVertexArray(mesh_);
    glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(vertices_.size() / 2));
  }

  GLuint depth() const { return textures_[0]; }
  GLuint normal() const { return textures_[1]; }

 private:
  void attach(GLenum type, const char* text) const {
    const GLuint shader = glCreateShader(type);
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    glAttachShader(program_, shader);
  }
  std::vector<vec3> vertices_;
  GLuint buffer_ = 0, mesh_ = 0, program_ = 0, framebuffer_ = 0, textures_[2] = {};
};

}  // namespace

int main() {
  gl::Context context = gl::Context::headless();  // in an engine's window: adopt_current()

  // A closed box whose walls emit 1 and reflect half: ½ of π arrives after one scattering, ¼ after two
  const scene::Scene scene = scene::make_builtin("box");
  const trace::PathTracer tracer(scene);
  bake::BakeParams params;
  params.face_size = 16;
  params.path = {.max_depth = 2, .passes = 1, .spp = 64, .seed = 1};
  params.viz = false;
  bake::BakeReport report;
  const probes::ProbeSet probes = bake::bake(tracer, place::init_from_scene(scene, 2), params, "", report);

  const Engine engine(scene);
  realtime::Renderer renderer(context, scene);
  renderer.set_probes(probes);

  const mat4 camera = scene::camera_pose(scene, "").world;
  const mat4 view_projection = glm::perspective(1.0f, 16.0f / 9, 0.01f, 50.0f) * glm::inverse(camera);
  engine.draw(view_projection);
  const gl::Texture& light = renderer.draw_indirect({.depth = engine.depth(),
                                                     .normal = engine.normal(),
                                                     .normal_from_zero = true,
                                                     .view_projection = view_projection});
  engine.draw(view_projection);  // OpenGL's state is the engine's still

  std::vector<vec4> texels(width * height);
  light.read({&texels[0].x, 4 * texels.size()}, 4);
  vec3 sum{0};
  for (const vec4& texel : texels) sum += vec3(texel) / float(texels.size());
  std::printf("%d x %d texels of indirect light, E/pi in the mean %.2f %.2f %.2f W/m2/sr\n", light.width(),
              light.height(), static_cast<double>(sum.x), static_cast<double>(sum.y),
              static_cast<double>(sum.z));
}
