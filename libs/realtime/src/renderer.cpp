#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/log.h>
#include <ssphh/gl/draw.h>
#include <ssphh/gl/timer.h>
#include <ssphh/realtime/renderer.h>

#include "frame_block.h"
#include "frame_images.h"
#include "lights.h"
#include "probes.h"
#include "shader_table.h"
#include "shaders.h"
#include "tables.h"

namespace ssphh::realtime {
namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

enum Pass { shadows, geometry, direct, indirect, occlusion, compose, resolve, display, pass_count };
constexpr const char* pass_names[pass_count] = {"shadows",   "geometry", "direct",  "indirect",
                                                "occlusion", "compose",  "resolve", "display"};

gl::Texture environment_map(const scene::Environment* environment) {
  const bool image = environment && !environment->equirect.empty();
  const image::Image one(1, 1, 3);
  const image::Image& source = image ? environment->equirect : one;
  gl::Texture texture(gl::Format::rgba32f, source.width, source.height);
  std::vector<vec4> texels;
  for (int y = 0; y < source.height; ++y) {
    for (int x = 0; x < source.width; ++x) {
      const vec3 color = environment ? environment->color * (image ? source.rgb(x, y) : vec3(1)) : vec3(0);
      texels.emplace_back(color, 1);
    }
  }
  texture.upload(std::as_bytes(std::span(texels)));
  texture.set_filter(true);
  return texture;
}

}  // namespace

struct Renderer::Data {
  Data(gl::Context& context_in, const scene::Scene& scene_in, const RendererParams& params_in, float time_in)
      : context(context_in),
        params(params_in),
        posed(pose_only(scene_in)),
        time(time_in),
        files(shader_table(), params_in.shader_directory),
        shaders(files),
        shaders_from(files.newest_change()),
        scene(scene_in, scene::world_matrices(scene_in, time_in), counters),
        lights(scene_in, scene::world_matrices(scene_in, time_in), scene.bounds(), params_in, counters),
        albedo(make_albedo_table()),
        glossy(make_glossy_bands()),
        sky(environment_map(lights.environment())),
        frame_buffer(sizeof(FrameBlock)) {
    sky_sampler = gl::Sampler(gl::Address::repeat, gl::Address::clamp, false);
    for (int i = 0; i < pass_count; ++i) timers.emplace_back(context.info().software);
    stats.passes.reserve(pass_count);
  }

  /// What poses need of a scene.
  static scene::Scene pose_only(const scene::Scene& scene) {
    scene::Scene s;
    s.nodes = scene.nodes;
    s.animations = scene.animations;
    s.materials = scene.materials;
    return s;
  }

  void reload_changed_shaders();
  template <class Draw>
  void run(Pass pass, const Draw& draw_pass) {
    timers[pass].begin();
    draw_pass();
    timers[pass].end();
    stats.passes.push_back({pass_names[pass], timers[pass].cpu_ms(), timers[pass].gpu_ms()});
  }
  void fullscreen(gl::Program& program, unsigned framebuffer, const gl::Rect& rect);
  void draw_shadows();
  void draw_geometry();
  void draw_direct();
  void draw_indirect();
  void draw_compose(const FrameSettings& settings);
  void draw_display(const FrameSettings& settings, const Target& target);

  gl::Context& context;
  RendererParams params;
  scene::Scene posed;  ///< nodes, animations and materials alone
  float time;
  FrameCounters counters;
  gl::ShaderFiles files;
  Shaders shaders;
  std::filesystem::file_time_type shaders_from;
  GpuScene scene;
  Lights lights;
  Probes probes;
  gl::Texture albedo, glossy, sky;
  gl::Sampler sky_sampler;
  gl::Buffer frame_buffer;
  gl::VertexArray no_vertices;
  FrameImages images;
  std::vector<gl::Timer> timers;
  FrameStats stats;
  std::vector<scene::Bounds> moved;
  bool drawn = false;
};

Renderer::Renderer(gl::Context& context, const scene::Scene& scene, const RendererParams& params, float time)
    : data_(std::make_unique<Data>(context, scene, params, time)) {
  context.throw_on_error("uploading the scene");
}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

void Renderer::set_time(float time) {
  Data& d = *data_;
  if (time == d.time) return;
  d.time = time;
  const std::vector<mat4> world = scene::world_matrices(d.posed, time);
  d.moved.clear();
  d.scene.pose(world, d.moved, d.counters);
  d.lights.invalidate(d.moved);
  d.probes.invalidate(d.moved);
  d.lights.set_time(world);
}

float Renderer::time() const {
  return data_->time;
}

void Renderer::set_light(int light, const scene::LightState& state) {
  if (light < 0 || light >= data_->lights.light_count())
    throw Error(fmt::format("light {}", light), fmt::format("the scene has {}", data_->lights.light_count()));
  bool finite = is_finite(state.color) && std::isfinite(state.intensity);
  for (int c = 0; c < 4; ++c) finite = finite && is_finite(vec3(state.world[c]));
  if (!finite) throw Error(fmt::format("light {}", light), "its state is not finite");
  data_->lights.set_light(light, state);
}

scene::LightState Renderer::light(int light) const {
  if (light < 0 || light >= data_->lights.light_count())
    throw Error(fmt::format("light {}", light), fmt::format("the scene has {}", data_->lights.light_count()));
  return data_->lights.light(light);
}

void Renderer::set_group_scale(int group, const vec3& scale) {
  if (group < 0 || group >= data_->lights.group_count())
    throw Error(fmt::format("light group {}", group),
                fmt::format("the scene has {}", data_->lights.group_count()));
  data_->lights.set_group_scale(group, scale);
  data_->scene.set_group_scale(group, scale, data_->counters);
}

void Renderer::set_material(int index, const scene::Material& material) {
  if (index < 0 || index >= static_cast<int>(data_->posed.materials.size()))
    throw Error(fmt::format("material {}", index),
                fmt::format("the scene has {}", data_->posed.materials.size()));
  data_->scene.set_material(index, material, data_->counters);
}

void Renderer::set_probes(const gi::ProbeSet& set, const gi::LookupParams& params) {
  Data& d = *data_;
  d.lights.clear_emissions();
  d.probes = Probes(set, params, d.params, d.scene.bounds(), d.counters);
  d.context.throw_on_error("uploading probes");
}

void Renderer::update_probes(std::span<const int> probes, std::span<const sh::RadianceSh> light) {
  SSPHH_CHECK(probes.size() == light.size());
  for (const int probe : probes) {
    if (probe < 0 || probe >= probe_count())
      throw Error(fmt::format("probe {}", probe), fmt::format("there are {}", probe_count()));
  }
  data_->probes.set_light(probes, light, data_->counters);
}

void Renderer::clear_probes() {
  data_->lights.clear_emissions();
  data_->probes = Probes();
}

int Renderer::probe_count() const {
  return data_->probes.count();
}

void Renderer::set_emission(int probe, const sh::RadianceSh& leaving, float radius) {
  if (probe < 0 || probe >= probe_count())
    throw Error(fmt::format("probe {}", probe), fmt::format("there are {}", probe_count()));
  const bool none = leaving.empty() || !(radius > 0);
  if (!none) data_->probes.set_emission(probe, leaving, data_->counters);
  data_->lights.set_emission(probe, data_->probes.position(probe), none ? 0 : radius);
}

const FrameStats& Renderer::draw(const scene::CameraPose& camera, const FrameSettings& settings,
                                 const Target& target) {
  Data& d = *data_;
  if (target.width < 1 || target.height < 1) throw Error("frame size", "width and height must be positive");
  const auto start = Clock::now();
  d.reload_changed_shaders();
  d.stats.passes.clear();
  d.stats.shadow_maps_drawn = d.stats.shadow_maps_waiting = 0;
  gl::apply_conventions();
  for (unsigned i = 0; i < 16; ++i) gl::Sampler::unbind(i);

  // Make room and tell the shaders what the frame is
  const int samples = std::clamp(settings.supersample, 1, 4),
            scale = std::clamp(settings.indirect_scale, 1, 8);
  if (!d.images.fits(target.width, target.height, samples, scale))
    d.images = FrameImages(target.width, target.height, samples, scale);
  const float aspect = static_cast<float>(target.width) / static_cast<float>(target.height);
  d.lights.prepare(camera, aspect, d.scene.bounds(), d.counters);
  const bool wants_direct = settings.direct && (settings.view == View::lit || settings.view == View::direct);
  const bool wants_indirect =
      d.probes.count() > 0 && settings.indirect &&
      (settings.view == View::lit || settings.view == View::indirect || settings.view == View::chosen_sphl);
  const FrameBlock block = frame_block(camera, settings, d.images, d.lights, d.probes, d.scene.bounds());
  upload(d.counters, d.frame_buffer, std::span<const FrameBlock>(&block, 1));
  d.frame_buffer.bind_uniform(binding::frame_block);

  d.run(shadows, [&] { d.draw_shadows(); });
  d.run(geometry, [&] { d.draw_geometry(); });
  d.images.gbuffer0.bind(unit::gbuffer0);
  d.images.gbuffer1.bind(unit::gbuffer1);
  d.images.depth.bind(unit::gbuffer_depth);
  d.albedo.bind(unit::albedo_table);
  if (wants_direct || settings.view == View::shadow) d.run(direct, [&] { d.draw_direct(); });
  if (wants_indirect) d.run(indirect, [&] { d.draw_indirect(); });
  if (wants_indirect && settings.ambient_occlusion)
    d.run(occlusion,
          [&] { d.fullscreen(d.shaders.occlusion, d.images.occlusion_pass.id(), d.images.full()); });
  d.run(compose, [&] { d.draw_compose(settings); });
  if (samples > 1) {
    d.run(resolve, [&] {
      d.shaders.resolve.set("scale", samples);
      d.images.color.bind(0);
      d.fullscreen(d.shaders.resolve, d.images.resolve_pass.id(), d.images.picture());
    });
  }
  if (target.framebuffer != Target::none) d.run(display, [&] { d.draw_display(settings, target); });

  d.drawn = true;
  d.stats.draw_calls = d.counters.draw_calls;
  d.stats.triangles = d.counters.triangles;
  d.stats.bytes_uploaded = d.counters.bytes_uploaded;
  d.counters = {};
  d.stats.cpu_ms = ms_since(start);
  d.context.throw_on_error("drawing a frame");
  return d.stats;
}

void Renderer::Data::reload_changed_shaders() {
  if (!files.on_disk()) return;
  const auto newest = files.newest_change();
  if (newest == shaders_from) return;
  shaders_from = newest;
  try {
    shaders = Shaders(files);
    log_info("shaders reloaded from {}", params.shader_directory.string());
  } catch (const Error& e) {
    log_warning("the shaders from before stay in use: {}", e.what());
  }
}

void Renderer::Data::fullscreen(gl::Program& program, unsigned framebuffer, const gl::Rect& rect) {
  gl::bind_framebuffer(framebuffer, rect);
  gl::apply({});
  program.use();
  no_vertices.bind();
  gl::draw_triangles(3);
  ++counters.draw_calls;
}

void Renderer::Data::draw_shadows() {
  int left = params.maps_per_frame;
  int& waiting = stats.shadow_maps_waiting;
  const int lamps = lights.update_maps(scene, shaders.shadow, shaders.shadow_alpha, left, waiting, counters);
  left = std::max(left - lamps, 0);
  stats.shadow_maps_drawn =
      lamps + probes.update_maps(scene, shaders.shadow, shaders.shadow_alpha, left, waiting, counters);
}

void Renderer::Data::draw_geometry() {
  gl::bind_framebuffer(images.geometry_pass.id(), images.full());
  gl::apply({.depth = gl::Depth::test_and_write});
  gl::clear_depth(images.full(), 0);
  gl::clear_color(2, 0, 0, 0, 0);
  shaders.geometry.use();
  scene.begin(false);
  for (const DrawItem& item : scene.items()) scene.draw(item, true, counters);
  for (unsigned i = 0; i < 16; ++i) gl::Sampler::unbind(i);
}

void Renderer::Data::draw_direct() {
  gl::bind_framebuffer(images.direct_pass.id(), images.full());
  gl::clear_color(0, 0, 0, 0, 0);
  lights.bind();
  probes.bind();
  fullscreen(shaders.direct, images.direct_pass.id(), images.full());
}

void Renderer::Data::draw_indirect() {
  probes.bind();
  glossy.bind(unit::glossy_bands);
  fullscreen(shaders.indirect, images.indirect_pass.id(), images.indirect());
}

void Renderer::Data::draw_compose(const FrameSettings& settings) {
  lights.bind();
  images.emitted.bind(unit::emitted);
  images.direct.bind(unit::direct);
  images.irradiance.bind(unit::irradiance);
  images.glossy.bind(unit::glossy);
  images.occlusion.bind(unit::occlusion);
  sky.bind(unit::environment);
  sky_sampler.bind(unit::environment);
  shaders.compose.set("show_sky", settings.sky == Sky::environment ? 1 : 0);
  fullscreen(shaders.compose, images.composed().id(), images.full());
  gl::Sampler::unbind(unit::environment);
}

void Renderer::Data::draw_display(const FrameSettings& settings, const Target& target) {
  const bool light =
      settings.view == View::lit || settings.view == View::direct || settings.view == View::indirect;
  shaders.display.set("plain", light ? 0 : 1);
  shaders.display.set("corner", target.x, target.y);
  images.resolved.bind(0);
  fullscreen(shaders.display, target.framebuffer, {target.x, target.y, target.width, target.height});
}

image::Image Renderer::read_back() const {
  const FrameImages& f = data_->images;
  if (!data_->drawn) throw Error("real-time renderer", "no frame was drawn yet");
  std::vector<float> texels(static_cast<std::size_t>(f.width) * static_cast<std::size_t>(f.height) * 4);
  f.resolved.read(texels, 4);
  image::Image out(f.width, f.height, 3);
  for (int y = 0; y < f.height; ++y) {
    for (int x = 0; x < f.width; ++x) {
      const auto row = static_cast<std::size_t>(f.height - 1 - y);
      const float* p = &texels[4 * (row * static_cast<std::size_t>(f.width) + static_cast<std::size_t>(x))];
      out.set_rgb(x, y, {p[0], p[1], p[2]});
    }
  }
  return out;
}

std::size_t Renderer::memory_bytes() const {
  const Data& d = *data_;
  return d.scene.bytes() + d.lights.bytes() + d.probes.bytes() + d.images.bytes() + d.sky.bytes();
}

std::string Renderer::shader_warnings() const {
  return data_->shaders.warnings();
}

}  // namespace ssphh::realtime
