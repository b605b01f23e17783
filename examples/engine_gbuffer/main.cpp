// An engine with a renderer of its own: draws depth and normals by plain OpenGL, has indirect light found on
// them, of meshes that stay where they are, and goes on.

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

// What an engine has anyway: its meshes, its program, its framebuffer.
class Engine {
 public:
  explicit Engine(const scene::Scene& scene) : scene_(scene), worlds_(scene::world_matrices(scene, 0)) {
    struct Vertex {
      vec3 position, normal;
      vec2 uv;
    };
    std::vector<Vertex> vertices;
    std::vector<uvec3> triangles;
    for (const scene::Mesh& mesh : scene.meshes) {
      places_.push_back({triangles.size() * sizeof(uvec3), vertices.size() * sizeof(Vertex)});
      for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        vertices.push_back({mesh.positions[i], mesh.normals[i], mesh.uvs[0][i]});
      triangles.insert(triangles.end(), mesh.triangles.begin(), mesh.triangles.end());
    }
    glCreateBuffers(2, buffers_);
    glNamedBufferStorage(buffers_[0], GLsizeiptr(vertices.size() * sizeof(Vertex)), vertices.data(), 0);
    glNamedBufferStorage(buffers_[1], GLsizeiptr(triangles.size() * sizeof(uvec3)), triangles.data(), 0);
    glCreateVertexArrays(1, &array_);
    glVertexArrayElementBuffer(array_, buffers_[1]);
    for (GLuint i = 0; i < 2; ++i) {
      glEnableVertexArrayAttrib(array_, i);
      glVertexArrayAttribFormat(array_, i, 3, GL_FLOAT, GL_FALSE, GLuint(i * sizeof(vec3)));
      glVertexArrayAttribBinding(array_, i, 0);
    }
    program_ = glCreateProgram();
    attach(GL_VERTEX_SHADER,
           "#version 450\nlayout(location = 0) in vec3 p; layout(location = 1) in vec3 n; out vec3 normal;\n"
           "layout(location = 0) uniform mat4 m; layout(location = 1) uniform mat4 world;\n"
           "void main() { gl_Position = m * world * vec4(p, 1); normal = normalize(mat3(world) * n); }");
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
    glBindVertexArray(array_);
    for (const scene::Instance& instance : scene_.instances) {
      const Place& place = places_[instance.mesh];
      glUniformMatrix4fv(1, 1, GL_FALSE, &worlds_[instance.node][0].x);
      glBindVertexBuffer(0, buffers_[0], GLintptr(place.vertices), vertex_bytes);
      glDrawElements(GL_TRIANGLES, GLsizei(3 * scene_.meshes[instance.mesh].triangles.size()),
                     GL_UNSIGNED_INT, reinterpret_cast<const void*>(place.triangles));
    }
  }

  // Where its meshes are: the library draws them from there, too.
  std::vector<realtime::MeshBuffers> meshes() const {
    std::vector<realtime::MeshBuffers> all;
    for (const Place& place : places_) {
      const auto attribute = [&](std::size_t offset) {
        return gl::VertexSource{buffers_[0], place.vertices + offset, vertex_bytes};
      };
      all.push_back({.mesh = int(all.size()),
                     .positions = attribute(0),
                     .normals = attribute(sizeof(vec3)),
                     .uvs = {attribute(2 * sizeof(vec3))},
                     .indices = {buffers_[1], place.triangles}});
    }
    return all;
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
  static constexpr int vertex_bytes = 2 * sizeof(vec3) + sizeof(vec2);
  struct Place {
    std::size_t triangles, vertices;  // bytes into the two buffers
  };
  const scene::Scene& scene_;
  std::vector<mat4> worlds_;
  std::vector<Place> places_;  // of each mesh
  GLuint buffers_[2] = {}, array_ = 0, program_ = 0, framebuffer_ = 0, textures_[2] = {};
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
  realtime::Renderer renderer(context, scene, {}, 0, engine.meshes());
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
