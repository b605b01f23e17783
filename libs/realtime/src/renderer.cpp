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

enum Pass { shadows, geometry, direct, indirect, seen, resolve, display, pass_count };
constexpr const char* pass_names[pass_count] = {"shadows", "geometry", "direct", "indirect",
                                                "seen",    "resolve",  "display"};

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
        scene(scene_in, scene::world_matrices(scene_in, time_in), context_in.info().software ? 1.0f : 8.0f,
              counters),
        lights(scene_in, scene::world_matrices(scene_in, time_in), scene.bounds(), params_in),
        albedo(make_albedo_table()),
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
  /// One triangle over the rectangle; `where` tells which pixels and how.
  void fullscreen(gl::Program& program, unsigned framebuffer, const gl::Rect& rect,
                  const gl::DrawState& where = {});
  /// For the classes of surfaces that reflect: draw(full, state).
  template <class Draw>
  void for_each_class(const Draw& draw_class);
  void draw_shadows();
  void draw_geometry(const FrameSettings& settings);
  void draw_direct(bool shadow_view);
  IndirectLookup lookup_of(const FrameSettings& settings) const;
  void draw_indirect(const FrameSettings& settings);
  void draw_indirect_by_images(const FrameSettings& settings);
  void draw_seen(const FrameSettings& settings);
  void draw_view();
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
  gl::Texture albedo, sky;
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
  d.probes = Probes(set, params, d.params, d.scene.bounds(), d.scene.any_full(), d.counters);
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
  data_->lights.set_emission(probe, data_->probes.position(probe), none ? 0 : radius, leaving);
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
  for (unsigned i = 0; i < unit::count; ++i) gl::Sampler::unbind(i);

  // Make room and tell the shaders what the frame is
  const int samples = std::clamp(settings.supersample, 1, 4),
            scale = std::clamp(settings.indirect_scale, 1, 8);
  if (!d.images.fits(target.width, target.height, samples, scale))
    d.images = FrameImages(target.width, target.height, samples, scale);
  const float aspect = static_cast<float>(target.width) / static_cast<float>(target.height);
  d.lights.prepare(camera, aspect, d.scene.bounds(), d.counters);
  const bool lit = settings.view == View::lit;
  const bool wants_direct = settings.direct && (lit || settings.view == View::direct);
  const bool wants_indirect =
      d.probes.count() > 0 &&
      (settings.view == View::chosen_sphl || (settings.indirect && (lit || settings.view == View::indirect)));
  if (wants_indirect && (d.scene.any_full() || settings.lookup == gi::LookupMethod::light))
    d.probes.want_radiance(d.counters);
  const FrameBlock block = frame_block(camera, settings, d.images, d.lights, d.probes, d.scene.bounds());
  upload(d.counters, d.frame_buffer, std::span<const FrameBlock>(&block, 1));
  d.frame_buffer.bind_uniform(binding::frame_block);

  d.run(shadows, [&] { d.draw_shadows(); });
  d.run(geometry, [&] { d.draw_geometry(settings); });
  d.images.gbuffer0.bind(unit::gbuffer0);
  d.images.gbuffer1.bind(unit::gbuffer1);
  d.albedo.bind(unit::albedo_table);
  if (wants_direct || settings.view == View::shadow)
    d.run(direct, [&] { d.draw_direct(settings.view == View::shadow); });
  if (wants_indirect) d.run(indirect, [&] { d.draw_indirect(settings); });
  if (wants_direct) d.run(seen, [&] { d.draw_seen(settings); });
  if (settings.view >= View::albedo && settings.view != View::chosen_sphl)
    d.run(seen, [&] { d.draw_view(); });
  if (samples > 1) {
    d.run(resolve, [&] {
      gl::Program& program = d.shaders.resolve();
      program.set_at(0, samples);
      d.images.color.bind(0);
      d.fullscreen(program, d.images.resolve_pass.id(), d.images.picture());
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
    Shaders changed(files);
    changed.compile_all();
    shaders = std::move(changed);
    log_info("shaders reloaded from {}", params.shader_directory.string());
  } catch (const Error& e) {
    log_warning("the shaders from before stay in use: {}", e.what());
  }
}

void Renderer::Data::fullscreen(gl::Program& program, unsigned framebuffer, const gl::Rect& rect,
                                const gl::DrawState& where) {
  gl::bind_framebuffer(framebuffer, rect);
  gl::apply(where);
  program.use();
  no_vertices.bind();
  gl::draw_triangles(3);
  ++counters.draw_calls;
}

template <class Draw>
void Renderer::Data::for_each_class(const Draw& draw_class) {
  draw_class(false, gl::DrawState{.blend = gl::Blend::add, .stencil_equal = surface_class::lambertian});
  if (scene.any_full())
    draw_class(true, gl::DrawState{.blend = gl::Blend::add, .stencil_equal = surface_class::full});
}

void Renderer::Data::draw_shadows() {
  int left = params.maps_per_frame;
  int& waiting = stats.shadow_maps_waiting;
  gl::Program &opaque = shaders.shadow(false), &alpha = shaders.shadow(true);
  const int lamps = lights.update_maps(scene, opaque, alpha, left, waiting, counters);
  left = std::max(left - lamps, 0);
  stats.shadow_maps_drawn = lamps + probes.update_maps(scene, opaque, alpha, left, waiting, counters);
}

void Renderer::Data::draw_geometry(const FrameSettings& settings) {
  gl::bind_framebuffer(images.geometry_pass.id(), images.full());
  gl::apply({.depth = gl::Depth::test_and_write});
  gl::clear_depth(images.full(), 0);
  gl::clear_stencil(surface_class::nothing);
  gl::clear_color_uint(0, 0, 0, 0, 0);
  gl::clear_color_uint(1, 0, 0, 0, 0);
  gl::clear_color(2, 0, 0, 0, 0);
  const bool emission = settings.direct && (settings.view == View::lit || settings.view == View::direct);
  scene.begin(false);
  int surface = -1, textures = -1;
  for (const DrawItem& item : scene.items()) {
    if (item.textures != textures) {
      textures = item.textures;
      gl::Program& program = shaders.geometry(textures);
      program.set("emission_shown", emission || settings.view == View::albedo ? 1 : 0);
      program.use();
    }
    if (item.surface_class != surface) {
      surface = item.surface_class;
      gl::apply({.depth = gl::Depth::test_and_write, .lines = settings.wireframe, .stencil_write = surface});
    }
    scene.draw(item, true, counters);
  }
  for (unsigned i = 0; i < unit::count; ++i) gl::Sampler::unbind(i);
}

void Renderer::Data::draw_direct(bool shadow_view) {
  lights.bind();
  if (probes.count() > 0) probes.bind_sight();
  const gl::Framebuffer& target = shadow_view ? images.shadow_pass : images.light_pass;
  if (shadow_view) {
    gl::bind_framebuffer(target.id(), images.full());
    gl::clear_color(0, 0, 0, 0, 0);
  }
  for (const Lights::Lit& lit : lights.lit()) {
    lights.bind_emitter(lit);
    for_each_class([&](bool full, const gl::DrawState& where) {
      fullscreen(shaders.direct(lit.kind, full, shadow_view), target.id(), images.full(), where);
    });
  }
}

IndirectLookup Renderer::Data::lookup_of(const FrameSettings& settings) const {
  if (settings.lookup == gi::LookupMethod::light) return IndirectLookup::light;
  // One probe has no spacing, nor anything to fit
  const bool fits = settings.weights != gi::WeightMethod::distance && probes.count() > 1;
  return fits ? IndirectLookup::mls : IndirectLookup::distance;
}

void Renderer::Data::draw_indirect(const FrameSettings& settings) {
  const bool chosen = settings.view == View::chosen_sphl;
  if (!chosen && (images.indirect_scale > 1 || settings.ambient_occlusion))
    return draw_indirect_by_images(settings);
  for_each_class([&](bool full, const gl::DrawState& where) {
    gl::Program& program = shaders.indirect(lookup_of(settings), full,
                                            chosen ? IndirectOutput::chosen : IndirectOutput::radiance);
    probes.bind_lookup(program);
    fullscreen(program, images.light_pass.id(), images.full(), where);
  });
}

void Renderer::Data::draw_indirect_by_images(const FrameSettings& settings) {
  gl::Program& program = shaders.indirect(lookup_of(settings), scene.any_full(), IndirectOutput::images);
  probes.bind_lookup(program);
  fullscreen(program, images.indirect_pass.id(), images.indirect());
  if (settings.ambient_occlusion) fullscreen(shaders.occlusion(), images.occlusion_pass.id(), images.full());
  images.irradiance.bind(unit::irradiance);
  images.glossy.bind(unit::glossy);
  images.occlusion.bind(unit::occlusion);
  for_each_class([&](bool full, const gl::DrawState& where) {
    fullscreen(shaders.apply(full), images.light_pass.id(), images.full(), where);
  });
}

void Renderer::Data::draw_seen(const FrameSettings& settings) {
  lights.bind();
  for (const Lights::Lit& lit : lights.lit()) {
    if (!lit.seen) continue;
    const bool behind = lit.kind != EmitterKind::sphere;
    if (behind && settings.sky == Sky::black) continue;
    lights.bind_emitter(lit);
    if (lit.kind == EmitterKind::environment) {
      sky.bind(unit::environment);
      sky_sampler.bind(unit::environment);
    }
    gl::DrawState where{.blend = gl::Blend::add};
    if (behind) where.stencil_equal = surface_class::nothing;
    fullscreen(shaders.seen(lit.kind), images.light_pass.id(), images.full(), where);
    gl::Sampler::unbind(unit::environment);
  }
}

void Renderer::Data::draw_view() {
  images.shadow.bind(unit::shadow_image);
  for_each_class([&](bool, const gl::DrawState& where) {
    fullscreen(shaders.view(), images.light_pass.id(), images.full(), where);
  });
}

void Renderer::Data::draw_display(const FrameSettings& settings, const Target& target) {
  const bool light =
      settings.view == View::lit || settings.view == View::direct || settings.view == View::indirect;
  gl::Program& program = shaders.display();
  program.set("plain", light ? 0 : 1);
  program.set("corner", target.x, target.y);
  images.result().bind(0);
  fullscreen(program, target.framebuffer, {target.x, target.y, target.width, target.height});
}

image::Image Renderer::read_back() const {
  const FrameImages& f = data_->images;
  if (!data_->drawn) throw Error("real-time renderer", "no frame was drawn yet");
  std::vector<float> texels(static_cast<std::size_t>(f.width) * static_cast<std::size_t>(f.height) * 4);
  f.result().read(texels, 4);
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

std::string Renderer::shader_warnings() {
  return data_->shaders.compile_all();
}

}  // namespace ssphh::realtime
