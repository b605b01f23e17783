#include <algorithm>
#include <cmath>

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

namespace {

constexpr double piece_ms = 8;
constexpr int most_pieces = 64, first_pieces = 16;

}  // namespace

int Renderer::Data::pieces_of(Pass pass) const {
  if (!in_pieces) return 1;
  const double ms = pass_ms[pass];
  // Of a pass that was not seen yet a software renderer may take a second.
  if (ms == 0) return context.info().software ? first_pieces : 1;
  return std::clamp(static_cast<int>(std::ceil(ms / piece_ms)), 1, most_pieces);
}

void Renderer::Data::in_bands(Pass pass, void (Data::*draw)()) {
  const int count = pieces_of(pass);
  for (int i = 0; i < count; ++i) todo.push_back({pass, draw, i, count});
}

void Renderer::Data::plan(const Eye& eye) {
  const FrameSettings& settings = frame_settings;
  const bool lit = settings.view == View::lit;
  const bool wants_direct = settings.direct && (lit || settings.view == View::direct);
  const bool wants_method = method && settings.indirect && (lit || settings.view == View::indirect);
  const bool wants_indirect =
      !wants_method && probes.count() > 0 &&
      (settings.view == View::chosen_sphl || (settings.indirect && (lit || settings.view == View::indirect)));
  if (wants_indirect &&
      (scene.any_full() || scene.any_glass() || settings.lookup == probes::LookupMethod::light))
    probes.want_radiance(counters);
  shadow_maps_left = params.maps_per_frame;
  todo.push_back({geometry, taken ? &Data::take_geometry : &Data::draw_geometry});
  if (!taken) todo.push_back({shadows, &Data::prepare_lights});
  todo.push_back({shadows, &Data::draw_shadows});
  if (wants_direct || settings.view == View::shadow) in_bands(direct, &Data::draw_direct);
  if (wants_indirect) {
    if (settings.ambient_occlusion) in_bands(indirect, &Data::draw_occlusion);
    const bool everywhere = images.indirect_scale == 1 || settings.view == View::chosen_sphl;
    in_bands(indirect, everywhere ? &Data::draw_indirect : &Data::draw_some_indirect);
    if (!everywhere) {
      todo.push_back({indirect, &Data::interpolate_indirect});
      todo.push_back({indirect, &Data::draw_other_indirect});
    }
  }
  if (wants_method) todo.push_back({indirect, &Data::draw_method});
  const bool over_glass = scene.any_glass() && !taken && settings.view != View::chosen_sphl &&
                          (wants_direct || wants_indirect || wants_method);
  const bool over_frost = over_glass && scene.any_frosted();
  if (wants_direct) in_bands(seen, &Data::draw_sky);
  if (over_frost) todo.push_back({glass, &Data::keep_behind_frost});
  if (wants_direct) in_bands(seen, &Data::draw_lamps);
  if (over_frost) {
    todo.push_back({glass, &Data::draw_frost});
    in_bands(glass, &Data::spread_behind_frost);
    if (wants_direct) in_bands(glass, &Data::draw_direct_behind_frost);
    if (wants_indirect) in_bands(glass, &Data::draw_indirect_behind_frost);
  }
  if (over_glass) {
    if (!over_frost) todo.push_back({glass, &Data::draw_through_glass});
    todo.push_back({glass, &Data::draw_glass});
    if (wants_direct) in_bands(glass, &Data::draw_direct_on_glass);
    if (wants_indirect) in_bands(glass, &Data::draw_indirect_on_glass);
  }
  if (settings.view >= View::albedo && settings.view != View::chosen_sphl)
    todo.push_back({seen, &Data::draw_view});
  if (images.supersample > 1) todo.push_back({resolve, &Data::draw_resolved});
  if (frame_target.framebuffer != Target::none) todo.push_back({display, &Data::draw_display});
  upload_frame_block(eye);
}

void Renderer::Data::upload_frame_block(const Eye& eye) {
  const FrameBlock block = frame_block(eye, frame_settings, images, lights, probes, scene.bounds());
  upload(counters, frame_buffer, std::span<const FrameBlock>(&block, 1));
  view_projection = clip_matrix(block);
}

void Renderer::show_again(const image::ToneMap& tone) {
  Data& d = *data_;
  if (!d.drawn) throw Error("real-time renderer", "no frame was drawn yet");
  if (d.frame_target.framebuffer == Target::none)
    throw Error("real-time renderer", "the last frame has no target to show it in");
  gl::apply_conventions();
  d.frame_settings.tone = tone;
  d.upload_frame_block(eye_of(d.frame_camera, d.frame_settings, d.images));
  d.frame_buffer.bind_uniform(binding::frame_block);
  d.draw_display();
  d.context.throw_on_error("showing a frame again");
}

void Renderer::begin(const scene::CameraPose& camera, const FrameSettings& settings, const Target& target) {
  data_->begin(camera, settings, target, true);
}

void Renderer::Data::begin(const scene::CameraPose& camera, const FrameSettings& settings,
                           const Target& target, bool in_pieces_now) {
  if (target.width < 1 || target.height < 1) throw Error("frame size", "width and height must be positive");
  const Stopwatch watch;
  in_pieces = in_pieces_now;
  taken.reset();
  make_room(settings, target);
  frame_camera = camera;
  choose_direct(settings);
  plan(eye_of(camera, settings, images));
  stats.cpu_ms = watch.milliseconds();
}

void Renderer::Data::make_room(const FrameSettings& settings, const Target& target) {
  todo.clear();
  next_piece = 0;
  frame_settings = settings;
  frame_target = target;
  reload_changed_shaders();
  stats.passes.clear();
  stats.shadow_maps_waiting = stats.shadow_maps_drawn = 0;
  now_ms.fill({});
  gl::apply_conventions();
  unbind_samplers();

  const int samples = std::clamp(settings.supersample, 1, 4),
            scale = std::clamp(settings.indirect_scale, 1, 8);
  if (!images.fits(target.width, target.height, samples, scale))
    images = FrameImages(target.width, target.height, samples, scale);
  drawn = false;
}

bool Renderer::step() {
  Data& d = *data_;
  if (d.next_piece >= d.todo.size()) return false;
  const Stopwatch watch;
  // The host may have drawn something of its own since the piece before.
  if (d.in_pieces) {
    gl::apply_conventions();
    unbind_samplers();
    d.images.gbuffer0.bind(unit::gbuffer0);
    d.images.gbuffer1.bind(unit::gbuffer1);
  }
  d.frame_buffer.bind_uniform(binding::frame_block);
  d.albedo.bind(unit::albedo_table);
  const Data::Piece piece = d.todo[d.next_piece];
  d.band = {piece.index, piece.count};
  {
    const gl::During timing(d.timers[piece.pass]);
    (d.*piece.draw)();
  }
  if (d.in_pieces && piece.count > 1 && !d.context.info().software) gl::finish();
  PassTime& sum = d.now_ms[piece.pass];
  sum.name = pass_names[piece.pass];
  sum.cpu_ms += d.timers[piece.pass].cpu_ms(), sum.gpu_ms += d.timers[piece.pass].gpu_ms();
  const bool again = piece.pass == shadows && d.in_pieces && d.more_shadows;
  if (!again) ++d.next_piece;
  const bool more = d.next_piece < d.todo.size();
  if (!more) d.finish_frame();
  d.stats.cpu_ms += watch.milliseconds();
  d.context.throw_on_error("drawing a frame");
  return more;
}

void Renderer::Data::finish_frame() {
  for (int pass = 0; pass < pass_count; ++pass) {
    const PassTime& time = now_ms[pass];
    if (*time.name == 0) continue;
    stats.passes.push_back(time);
    pass_ms[pass] = std::max(time.cpu_ms, time.gpu_ms);
  }
  band = {0, 1};
  drawn = true;
  stats.samples_shaded = shaded.count();
  stats.draw_calls = counters.draw_calls;
  stats.triangles = counters.triangles;
  stats.bytes_uploaded = counters.bytes_uploaded;
  counters = {};
}

const FrameStats& Renderer::stats() const {
  return data_->stats;
}

const FrameStats& Renderer::draw(const scene::CameraPose& camera, const FrameSettings& settings,
                                 const Target& target) {
  data_->begin(camera, settings, target, false);
  while (step()) {
  }
  return data_->stats;
}

}  // namespace ssphh::realtime
