#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/require.h>
#include <ssphh/realtime/renderer.h>

#include "albedo_texture.h"
#include "renderer_data.h"
#include "shader_table.h"

namespace ssphh::realtime {
namespace {

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

/// What poses need of a scene.
scene::Scene pose_only(const scene::Scene& scene) {
  scene::Scene s;
  s.nodes = scene.nodes;
  s.animations = scene.animations;
  s.materials = scene.materials;
  return s;
}

}  // namespace

Renderer::Data::Data(gl::Context& context_in, const scene::Scene& scene_in, const RendererParams& params_in,
                     float time_in, std::span<const MeshBuffers> engines)
    : context(context_in),
      params(params_in),
      posed(pose_only(scene_in)),
      lighting(scene::lighting_at(scene_in, time_in)),
      world(scene::world_matrices(scene_in, time_in)),
      files(shader_table(), params_in.shader_directory),
      shaders(files),
      shaders_from(files.newest_change()),
      scene(scene_in, engines, world, context_in.info().software ? 1.0f : 8.0f, counters),
      lights(scene_in, time_in, world, scene.bounds(), params_in),
      albedo(make_albedo_table()),
      sky(environment_map(lights.environment())),
      frame_buffer(sizeof(FrameBlock)),
      shaded(context_in.info().software) {
  sky_sampler = gl::Sampler(gl::Address::repeat, gl::Address::clamp, false);
  texel_sampler = gl::Sampler(gl::Address::clamp, gl::Address::clamp, true);
  for (int i = 0; i < pass_count; ++i) timers.emplace_back(context.info().software);
  stats.passes.reserve(pass_count);
}

void Renderer::Data::pose(float time) {
  world = scene::world_matrices(posed, time);
  moved.clear();
  scene.pose(world, moved, counters);
  lights.invalidate(moved);
  probes.invalidate(moved);
  if (method) method->invalidate(moved);
}

void Renderer::Data::show_environment() {
  sky = environment_map(lights.environment());
  sky_lobes = TileAtlas();
}

void Renderer::Data::emit(const std::vector<scene::SphlEmission>& emission) {
  lights.clear_emissions();
  for (const scene::SphlEmission& sphl : emission) {
    const float radius = probes.radius(sphl.probe);
    if (sphl.leaving.empty() || !(radius > 0)) continue;
    probes.see_all(sphl.probe);
    lights.add_emission(sphl.probe, probes.position(sphl.probe), radius, sphl.leaving);
  }
}

void Renderer::Data::keep_direct(const probes::ProbeSet& set) {
  baked_groups = probes::baked_groups(set);
  mirrored_groups = probes::mirrored_groups(set);
  if (!set.probes.empty()) probes.set_light_of_moving(probes::light_beside_records(set), counters);
  direct_choice.reset();
}

void Renderer::Data::choose_direct(const FrameSettings& settings) {
  const DirectChoice now{.by_probes = !method,
                         .by_records = !method && settings.indirect && probes.has_records() &&
                                       lookup_of(settings) == IndirectLookup::surface};
  if (direct_choice == now) return;
  direct_choice = now;
  std::vector<std::string> groups, mirrored;
  if (now.by_probes) groups = baked_groups;
  if (now.by_records) mirrored = mirrored_groups;
  groups.insert(groups.end(), mirrored.begin(), mirrored.end());
  // Where nothing is glossy, nothing mirrors
  if (!scene.any_full() && !scene.any_glass()) mirrored.clear();
  lights.leave_out(groups, mirrored);
  probes.use_light_of_moving(now.by_records);
}

Renderer::Renderer(gl::Context& context, const scene::Scene& scene, const RendererParams& params, float time,
                   std::span<const MeshBuffers> engines) {
  scene::check_indices(scene);
  require(std::isfinite(time), "time", "it must be a finite number of seconds");
  context.forget_errors();
  data_ = std::make_unique<Data>(context, scene, params, time, engines);
  // What was uploaded is at full strength, dark groups as well.
  const scene::LightingState own = data_->lighting;
  data_->lighting.group_scales.assign(own.group_scales.size(), vec3(1));
  set(own);
  context.throw_on_error("uploading the scene");
}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

void Renderer::set(const scene::LightingState& state) {
  Data& d = *data_;
  scene::check_lighting(state, {d.lighting.lights.size(), d.lighting.group_scales.size(),
                                static_cast<std::size_t>(d.probes.count())});
  if (state == d.lighting) return;
  if (state.time != d.lighting.time) d.pose(state.time);
  for (std::size_t g = 0; g < state.group_scales.size(); ++g) {
    if (state.group_scales[g] != d.lighting.group_scales[g])
      d.scene.set_group_scale(static_cast<int>(g), state.group_scales[g], d.counters);
  }
  const bool other_sky = state.environment_image != d.lights.other_environment();
  d.lights.set(state, d.world);
  if (other_sky) d.show_environment();
  if (state.emission != d.lighting.emission) d.emit(state.emission);
  d.lighting = state;
}

void Renderer::set_lamps(const scene::Scene& scene) {
  Data& d = *data_;
  scene::check_indices(scene);
  require(d.scene.stands_in(scene) && scene.materials.size() == d.posed.materials.size(), "lamps",
          "they are of a scene with other geometry");
  scene::LightingState state = scene::lighting_at(scene, d.lighting.time);
  state.environment_rotation = d.lighting.environment_rotation;
  state.environment_image = d.lighting.environment_image;
  state.emission = d.lighting.emission;
  std::vector<mat4> world = scene::world_matrices(scene, state.time);
  Lights lights(scene, state.time, world, d.scene.bounds(), d.params, &d.lights);
  d.context.throw_on_error("making lamps");
  lights.take_from(d.lights, world);
  lights.set(state, world);
  const bool same_sky = lights.same_sky();
  d.todo.clear(), d.next_piece = 0;
  d.lights = std::move(lights);
  if (!same_sky) d.show_environment();
  d.posed = pose_only(scene);
  d.world = std::move(world);
  d.scene.set_groups(scene, state.group_scales, d.counters);
  d.emit(state.emission);
  d.direct_choice.reset();
  d.lighting = std::move(state);
}

const scene::LightingState& Renderer::lighting() const {
  return data_->lighting;
}

void Renderer::set_material(int index, const scene::Material& material) {
  if (index < 0 || index >= static_cast<int>(data_->posed.materials.size()))
    throw Error(fmt::format("material {}", index),
                fmt::format("the scene has {}", data_->posed.materials.size()));
  data_->scene.set_material(index, material, data_->counters);
  data_->direct_choice.reset();  // it may be what is glossy
  if (material.is_glass()) data_->lights.invalidate_all();
}

void Renderer::set_probes(const probes::ProbeSet& set, const probes::LookupParams& params) {
  Data& d = *data_;
  d.forget_emission();
  d.probes =
      Probes(set, params, d.params, d.scene.bounds(), d.scene.any_full() || d.scene.any_glass(), d.counters);
  d.keep_direct(set);
  d.context.throw_on_error("uploading probes");
}

void Renderer::set_kept_light(const probes::ProbeSet& set) {
  require(static_cast<int>(set.probes.size()) == data_->probes.count(), "kept light",
          "it is of other probes than those that were set");
  data_->keep_direct(set);
}

void Renderer::set_fitted(const probes::FittedSurfaces& fitted) {
  Data& d = *data_;
  d.probes.set_fitted(fitted, d.counters);
  d.context.throw_on_error("uploading fitted weights");
}

void Renderer::set_records(const probes::SurfaceLists& lists) {
  Data& d = *data_;
  d.probes.set_records(lists, d.counters);
  d.context.throw_on_error("uploading surface records");
}

void Renderer::set_record_light(std::span<const probes::RecordLight> light) {
  data_->probes.set_record_light(light, data_->counters);
}

void Renderer::update_probes(std::span<const int> probes, std::span<const sh::RadianceSh> light) {
  require(probes.size() == light.size(), "probes", "there is not one function for each");
  data_->probes.set_light(probes, light, data_->counters);
}

void Renderer::clear_probes() {
  data_->forget_emission();
  data_->probes = Probes();
  data_->keep_direct({});
}

int Renderer::probe_count() const {
  return data_->probes.count();
}

void Renderer::set_method_light(const methods::LightData& light) {
  Data& d = *data_;
  if (!d.method || !d.method->take(light, d.counters)) {
    d.method.reset();  // first: the two would not always fit side by side
    d.method = make_method_light(light, d.params, d.scene.bounds(), d.counters);
  }
  d.context.throw_on_error("uploading a method's light");
}

void Renderer::clear_method_light() {
  data_->method.reset();
}

methods::MethodNumbers Renderer::method_numbers() const {
  return data_->method ? data_->method->numbers() : methods::MethodNumbers();
}

namespace {

image::Image image_of(const gl::Texture& texture) {
  const int width = texture.width(), height = texture.height();
  std::vector<float> texels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
  texture.read(texels, 4);
  image::Image out(width, height, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto row = static_cast<std::size_t>(height - 1 - y);
      const float* p = &texels[4 * (row * static_cast<std::size_t>(width) + static_cast<std::size_t>(x))];
      out.set_rgb(x, y, {p[0], p[1], p[2]});
    }
  }
  return out;
}

}  // namespace

image::Image Renderer::read_back() const {
  if (!data_->drawn) throw Error("real-time renderer", "no frame was drawn yet");
  return image_of(data_->images.result());
}

image::Image Renderer::read_some(int width, int height) const {
  const FrameImages& f = data_->images;
  if (width >= f.width && height >= f.height) return read_back();
  if (!data_->drawn) throw Error("real-time renderer", "no frame was drawn yet");
  if (width < 1 || height < 1) throw Error("real-time renderer", "there is no picture without pixels");
  const gl::Texture& all = f.result();
  const gl::Texture some(all.format(), std::min(width, f.width), std::min(height, f.height));
  const gl::Texture *const from[] = {&all}, *const to[] = {&some};
  gl::copy_colors(gl::Framebuffer(from, nullptr), f.picture(), gl::Framebuffer(to, nullptr),
                  {0, 0, some.width(), some.height()});
  return image_of(some);
}

const gl::Texture& Renderer::depth_texture() const {
  return data_->images.depth;
}

mat4 Renderer::view_projection() const {
  return data_->view_projection;
}

std::size_t Renderer::memory_bytes() const {
  const Data& d = *data_;
  return d.scene.bytes() + d.lights.bytes() + d.probes.bytes() + d.images.bytes() + d.sky.bytes() +
         d.sky_lobes.bytes() + (d.method ? d.method->bytes() : 0);
}

std::string Renderer::shader_warnings() {
  return data_->shaders.compile_all();
}

}  // namespace ssphh::realtime
