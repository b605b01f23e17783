#include <algorithm>

#include "renderer_data.h"

namespace ssphh::realtime {

void Renderer::Data::fullscreen(gl::Program& program, unsigned framebuffer, const gl::Rect& rect,
                                const gl::DrawState& where) {
  const int from = rect.height * band.index / band.count, to = rect.height * (band.index + 1) / band.count;
  if (from == to) return;
  gl::bind_framebuffer(framebuffer, {rect.x, rect.y + from, rect.width, to - from});
  gl::apply(where);
  program.use();
  no_vertices.bind();
  gl::draw_triangles(3);
  ++counters.draw_calls;
}

void Renderer::Data::prepare_lights() {
  const float aspect = static_cast<float>(frame_target.width) / static_cast<float>(frame_target.height);
  const Seen seen = lights.any_sun() ? seen_places.measure(shaders, no_vertices) : Seen{};
  lights.prepare(frame_camera, aspect, seen, scene.bounds(), counters);
}

void Renderer::Data::draw_shadows() {
  int left = in_pieces ? std::min(shadow_maps_left, 1) : shadow_maps_left;
  int& waiting = stats.shadow_maps_waiting;
  waiting = 0;
  gl::Program &opaque = shaders.shadow(false), &alpha = shaders.shadow(true);
  int lamps = 0;
  if (!taken) {
    gl::Program* glass = scene.any_glass() ? &shaders.glass_shadow() : nullptr;
    lamps = lights.update_maps(scene, opaque, alpha, glass, left, waiting, counters);
    left = std::max(left - lamps, 0);
    lights.update_bounds(shaders, no_vertices, counters);
  }
  const int of_probes = probes.update_maps(scene, opaque, alpha, left, waiting, counters);
  left -= of_probes;
  int drawn_now = lamps + of_probes;
  if (method) drawn_now += method->update_maps(scene, opaque, alpha, left, waiting, counters);
  unbind_samplers();
  stats.shadow_maps_drawn += drawn_now;
  shadow_maps_left -= drawn_now;
  more_shadows = waiting > 0 && drawn_now > 0 && shadow_maps_left > 0;
}

void Renderer::Data::draw_geometry() {
  const gl::During counting(shaded);
  gl::bind_framebuffer(images.geometry_pass.id(), images.full());
  gl::apply({.depth = gl::Depth::test_and_write});
  gl::clear_depth(images.full(), 0);
  gl::clear_stencil(surface_class::nothing);
  gl::clear_color_uint(0, 0, 0, 0, 0);
  gl::clear_color_uint(1, 0, 0, 0, 0);
  gl::clear_color(2, 0, 0, 0, 0);
  draw_items(GlassLayer::opaque, {.depth = gl::Depth::test_and_write, .lines = frame_settings.wireframe},
             [](const DrawItem&) { return true; });
  images.gbuffer0.bind(unit::gbuffer0);
  images.gbuffer1.bind(unit::gbuffer1);
  if (!frame_settings.wireframe) mend_cracks();
}

void Renderer::Data::mend_cracks() {
  images.gbuffer0.bind_image(unit::gbuffer0_image);
  images.gbuffer1.bind_image(unit::gbuffer1_image);
  fullscreen(shaders.mend_cracks(), images.light_pass.id(), images.full(), {.color_write = false});
  gl::shader_memory_barrier();
}

template <class Wanted>
void Renderer::Data::draw_items(GlassLayer layer, gl::DrawState state, const Wanted& wanted) {
  const FrameSettings& settings = frame_settings;
  const bool emission = settings.direct && (settings.view == View::lit || settings.view == View::direct);
  scene.begin(false);
  const bool writes_class =
      layer == GlassLayer::opaque || layer == GlassLayer::frosted || layer == GlassLayer::reflecting;
  int surface = -1, textures = -1, glass_programs = -1;
  for (const DrawItem& item : scene.items()) {
    if (!wanted(item)) continue;
    if (item.textures != textures || int{item.glass} != glass_programs) {
      textures = item.textures, glass_programs = item.glass;
      const bool bent = layer == GlassLayer::bent;
      gl::Program& program = shaders.geometry(textures, item.glass, bent);
      program.set("emission_shown", emission ? 1 : settings.view == View::albedo ? 2 : 0);
      if (item.glass) {
        program.set("glass_layer", static_cast<int>(layer));
        program.set("any_bends", int{scene.any_bends()});
        if (bent) program.set("bent_steps", 32);
      }
      program.use();
    }
    const int surface_now = layer == GlassLayer::opaque ? item.surface_class : surface_class::full;
    if (surface_now != surface) {
      surface = surface_now;
      if (writes_class) state.stencil_write = surface;
      gl::apply(state);
    }
    scene.draw(item, true, counters);
  }
  unbind_samplers();
}

void Renderer::Data::bend_light() {
  const auto bends = [](const DrawItem& item) { return item.bends; };
  images.want_bodies();
  const gl::Rect full = images.full();
  gl::bind_framebuffer(images.exits_pass.id(), full);
  gl::apply({.depth = gl::Depth::test_and_write});
  gl::clear_depth(full, 0);
  gl::clear_color_uint(0, 0, 0, 0, 0);
  draw_items(GlassLayer::exits, {.depth = gl::Depth::test_and_write}, bends);
  gl::copy_texels({images.color}, {images.behind_glass}, full.width, full.height);
  images.exits.bind(unit::exits);
  images.behind_glass.bind(unit::behind_glass);
  gl::bind_framebuffer(images.bent_pass.id(), full);
  draw_items(GlassLayer::bent, {.depth = gl::Depth::test}, bends);
}

namespace {

bool is_glass(const DrawItem& item) {
  return item.glass;
}

}  // namespace

void Renderer::Data::draw_through_glass() {
  images.gbuffer1.bind(unit::gbuffer1);
  if (scene.any_bends()) bend_light();
  gl::bind_framebuffer(images.glass_pass.id(), images.full());
  draw_items(GlassLayer::through, {.blend = gl::Blend::multiply}, is_glass);
}

void Renderer::Data::keep_behind_frost() {
  images.want_frost();
  const gl::Rect full = images.full();
  gl::copy_texels({images.color}, {images.behind_frost}, full.width, full.height);
  images.behind_frost.generate_mipmaps();
  gl::copy_texels({images.gbuffer1}, {images.behind_gbuffer1}, full.width, full.height);
}

void Renderer::Data::draw_frost() {
  images.gbuffer1.bind(unit::gbuffer1);
  if (scene.any_bends()) bend_light();
  gl::bind_framebuffer(images.left_by_glass_pass.id(), images.full());
  gl::clear_color(2, 1, 1, 1, 1);
  draw_items(GlassLayer::through, {.blend = gl::Blend::multiply}, is_glass);
  gl::bind_framebuffer(images.geometry_pass.id(), images.full());
  gl::clear_stencil(surface_class::nothing);
  draw_items(GlassLayer::frosted, {.depth = gl::Depth::test_and_write, .blend = gl::Blend::add},
             [](const DrawItem& item) { return item.frosted; });
}

void Renderer::Data::spread_behind_frost() {
  images.left_by_glass.bind(unit::left_by_glass);
  images.behind_frost.bind(unit::behind_glass);
  images.behind_gbuffer1.bind(unit::behind_gbuffer1);
  const unsigned target = images.light_pass.id();
  fullscreen(shaders.behind_glass(false), target, images.full(),
             {.blend = gl::Blend::multiply, .stencil_equal = surface_class::nothing});
  gl::Program& spread = shaders.behind_glass(true);
  spread.set("taps", 32);
  spread.set("steps", 12);
  fullscreen(spread, target, images.full(), {.stencil_equal = surface_class::full});
}

void Renderer::Data::draw_glass() {
  gl::bind_framebuffer(images.geometry_pass.id(), images.full());
  gl::clear_stencil(surface_class::nothing);
  draw_items(GlassLayer::reflecting, {.depth = gl::Depth::test_and_write, .blend = gl::Blend::add}, is_glass);
}

void Renderer::Data::add_indirect_on_glass(gl::Blend blend) {
  fullscreen(indirect_program(true, IndirectOutput::radiance), images.light_pass.id(), images.full(),
             {.blend = blend, .stencil_equal = surface_class::full});
}

void Renderer::Data::bind_sky_lobes(gl::Program& program) {
  if (sky_lobes.bytes() == 0) sky_lobes = environment_tiles(*lights.environment());
  sky_lobes.bind(unit::environment_tiles);
  program.set("environment_layout", sky_lobes.size(), sky_lobes.layout().columns_log2);
  program.set("environment_roughness", std::span<const float>(environment_roughness));
}

void Renderer::Data::add_direct(GlassLayer layer) {
  const bool shadow_view = frame_settings.view == View::shadow;
  lights.bind();
  if (probes.count() > 0) probes.bind_sight();
  const gl::Framebuffer& target = shadow_view ? images.shadow_pass : images.light_pass;
  if (shadow_view && band.index == 0) {
    gl::bind_framebuffer(target.id(), images.full());
    gl::clear_color(0, 0, 0, 0, 0);
  }
  for (const Lights::Lit& lit : lights.lit()) {
    if (!lit.lights) continue;
    gl::DrawState on_glass = of_class(surface_class::full);
    if (layer == GlassLayer::frosted) {
      if (lit.kind == EmitterKind::mesh && !lit.seen) continue;  // the picture shows it
      if (lit.kind == EmitterKind::environment) on_glass.blend = gl::Blend::add_to_rest;
    }
    lights.bind_emitter(lit);
    const auto draw_class = [&](bool full, const gl::DrawState& where) {
      if (lit.mirrors && (shadow_view || !full)) return;
      // Glass itself is lit by what has not passed it yet
      const bool filtered = scene.any_glass() && layer == GlassLayer::opaque;
      gl::Program& program = lit.mirrors ? shaders.mirrored_environment(filtered)
                                         : shaders.direct(lit.kind, full, shadow_view, filtered);
      if (full && lit.kind == EmitterKind::environment) bind_sky_lobes(program);
      fullscreen(program, target.id(), images.full(), where);
    };
    layer == GlassLayer::opaque ? for_each_class(draw_class) : draw_class(true, on_glass);
  }
}

IndirectLookup Renderer::Data::lookup_of(const FrameSettings& settings) const {
  if (settings.lookup == probes::LookupMethod::light) return IndirectLookup::light;
  const bool surface = settings.weights == probes::WeightMethod::surface,
             fitted = surface || settings.weights == probes::WeightMethod::fitted;
  if ((surface && probes.has_records()) || (fitted && probes.has_fitted())) return IndirectLookup::surface;
  // One probe has no spacing, nor anything to fit
  if (settings.weights == probes::WeightMethod::distance || probes.count() < 2)
    return IndirectLookup::distance;
  return settings.weights == probes::WeightMethod::trilinear ? IndirectLookup::trilinear
                                                             : IndirectLookup::mls;
}

gl::Program& Renderer::Data::indirect_program(bool full, IndirectOutput output) {
  gl::Program& program = shaders.indirect(lookup_of(frame_settings), full, output);
  probes.bind_lookup(program);
  return program;
}

void Renderer::Data::draw_indirect() {
  const bool chosen = frame_settings.view == View::chosen_sphl;
  for_each_class([&](bool full, const gl::DrawState& where) {
    fullscreen(indirect_program(full, chosen ? IndirectOutput::chosen : IndirectOutput::radiance),
               images.light_pass.id(), images.full(), where);
  });
}

void Renderer::Data::draw_some_indirect() {
  fullscreen(indirect_program(scene.any_full(), IndirectOutput::images), images.indirect_pass.id(),
             images.indirect());
}

void Renderer::Data::draw_other_indirect() {
  draw_listed(indirect_program(scene.any_full(), IndirectOutput::listed));
}

void Renderer::Data::draw_occlusion() {
  fullscreen(shaders.occlusion(), images.occlusion_pass.id(), images.full());
  images.occlusion.bind(unit::occlusion);
}

void Renderer::Data::interpolate_indirect() {
  images.irradiance.bind(unit::irradiance);
  images.glossy.bind(unit::glossy);
  fullscreen(shaders.agree(scene.any_full()), images.cells_pass.id(), images.indirect());
  images.cells.bind(unit::cells);
  upload(counters, images.listed, std::span<const ListHead>(&empty_list, 1));
  images.listed.bind_storage(binding::listed_pixels);
  fullscreen(shaders.mark(), images.light_pass.id(), images.full(),
             {.color_write = false, .stencil_mark = surface_class::lit});
  for_each_class([&](bool full, gl::DrawState where) {
    where.stencil_equal |= surface_class::lit;
    fullscreen(shaders.interpolate(full), images.light_pass.id(), images.full(), where);
  });
}

void Renderer::Data::draw_listed(gl::Program& program) {
  images.color.bind_image(unit::color_image);
  program.use();
  gl::shader_memory_barrier();
  gl::dispatch(images.listed);
  gl::shader_memory_barrier();
}

void Renderer::Data::draw_seen(bool environment) {
  lights.bind();
  for (const Lights::Lit& lit : lights.lit()) {
    if (!lit.seen || (lit.kind == EmitterKind::environment) != environment) continue;
    const bool behind = lit.kind != EmitterKind::sphere && lit.kind != EmitterKind::mesh;
    if (behind && frame_settings.sky == Sky::black) continue;
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

void Renderer::Data::draw_resolved() {
  gl::Program& program = shaders.resolve();
  program.set_at(0, images.supersample);
  images.color.bind(unit::picture);
  fullscreen(program, images.resolve_pass.id(), images.picture());
}

void Renderer::Data::draw_display() {
  const View view = frame_settings.view;
  const bool light = view == View::lit || view == View::direct || view == View::indirect;
  const Target& target = frame_target;
  gl::Program& program = shaders.display();
  program.set("plain", light ? 0 : 1);
  program.set("corner", target.x, target.y);
  images.result().bind(unit::picture);
  fullscreen(program, target.framebuffer, {target.x, target.y, target.width, target.height});
}

}  // namespace ssphh::realtime
