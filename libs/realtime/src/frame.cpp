#include <algorithm>

#include <ssphh/core/log.h>
#include <ssphh/core/stopwatch.h>

#include "frame_block.h"
#include "renderer_data.h"

namespace ssphh::realtime {
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

const FrameStats& Renderer::draw(const scene::CameraPose& camera, const FrameSettings& settings,
                                 const Target& target) {
  Data& d = *data_;
  if (target.width < 1 || target.height < 1) throw Error("frame size", "width and height must be positive");
  const Stopwatch watch;
  d.reload_changed_shaders();
  d.stats.passes.clear();
  d.stats.shadow_maps_waiting = 0;
  gl::apply_conventions();
  for (unsigned i = 0; i < unit::count; ++i) gl::Sampler::unbind(i);

  // Make room and tell the shaders what the frame is
  const int samples = std::clamp(settings.supersample, 1, 4),
            scale = std::clamp(settings.indirect_scale, 1, 8);
  if (!d.images.fits(target.width, target.height, samples, scale))
    d.images = FrameImages(target.width, target.height, samples, scale);
  const float aspect = static_cast<float>(target.width) / static_cast<float>(target.height);
  d.choose_direct(settings);
  d.lights.prepare(camera, aspect, d.scene.bounds(), d.counters);
  const bool lit = settings.view == View::lit;
  const bool wants_direct = settings.direct && (lit || settings.view == View::direct);
  const bool wants_method = d.method && settings.indirect && (lit || settings.view == View::indirect);
  const bool wants_indirect =
      !wants_method && d.probes.count() > 0 &&
      (settings.view == View::chosen_sphl || (settings.indirect && (lit || settings.view == View::indirect)));
  if (wants_indirect &&
      (d.scene.any_full() || d.scene.any_glass() || settings.lookup == probes::LookupMethod::light))
    d.probes.want_radiance(d.counters);
  const FrameBlock block = frame_block(camera, settings, d.images, d.lights, d.probes, d.scene.bounds());
  upload(d.counters, d.frame_buffer, std::span<const FrameBlock>(&block, 1));
  d.frame_buffer.bind_uniform(binding::frame_block);
  d.view_projection = clip_matrix(block);

  d.albedo.bind(unit::albedo_table);
  d.run(shadows, [&] { d.draw_shadows(); });
  d.run(geometry, [&] {
    const gl::During counting(d.shaded);
    d.draw_geometry(settings);
  });
  d.images.gbuffer0.bind(unit::gbuffer0);
  d.images.gbuffer1.bind(unit::gbuffer1);
  if (wants_direct || settings.view == View::shadow)
    d.run(direct, [&] { d.draw_direct(settings.view == View::shadow); });
  if (wants_indirect) d.run(indirect, [&] { d.draw_indirect(settings); });
  if (wants_method) d.run(indirect, [&] { d.draw_method(settings); });
  if (wants_direct) d.run(seen, [&] { d.draw_seen(settings); });
  const bool shows_light = wants_direct || wants_indirect || wants_method;
  if (d.scene.any_glass() && shows_light && settings.view != View::chosen_sphl)
    d.run(glass, [&] { d.draw_glass(settings, wants_direct, wants_indirect); });
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
  d.stats.samples_shaded = d.shaded.count();
  d.stats.draw_calls = d.counters.draw_calls;
  d.stats.triangles = d.counters.triangles;
  d.stats.bytes_uploaded = d.counters.bytes_uploaded;
  d.counters = {};
  d.stats.cpu_ms = watch.milliseconds();
  d.context.throw_on_error("drawing a frame");
  return d.stats;
}

}  // namespace ssphh::realtime
