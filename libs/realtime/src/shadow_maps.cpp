#include "shadow_maps.h"

#include <ssphh/gl/draw.h>

namespace ssphh::realtime {
namespace {

enum State : std::uint8_t { stale, fresh, unused, unwanted };

constexpr int shadow_atlas_side = 4096;

struct FaceAxes {
  vec3 right, up, forward;
};
constexpr FaceAxes axes[6] = {{{0, 0, -1}, {0, 1, 0}, {1, 0, 0}}, {{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}},
                              {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}, {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
                              {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},  {{-1, 0, 0}, {0, 1, 0}, {0, 0, -1}}};

}  // namespace

MapView cube_view(const vec3& origin, int face, float near_plane, float reach) {
  const FaceAxes& a = axes[face];
  return {origin, a.right, a.up, a.forward, near_plane, reach};
}

bool sees_box(const MapView& view, const scene::Bounds& box) {
  const vec3 away = glm::clamp(view.origin, box.min, box.max) - view.origin;
  if (glm::dot(away, away) > view.reach * view.reach) return false;
  // Outside if all corners lie beyond one and the same edge
  bool left = true, right = true, below = true, above = true, behind = true;
  for (int i = 0; i < 8; ++i) {
    const vec3 p =
        vec3(i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z) -
        view.origin;
    const float x = glm::dot(p, view.right), y = glm::dot(p, view.up), z = glm::dot(p, view.forward);
    const float edge = view.near_plane > 0 ? 1.01f * z : 1.0f;
    left &= x<-edge, right &= x> edge, below &= y<-edge, above &= y> edge;
    behind &= z < 0;
  }
  return !(left || right || below || above || behind);
}

MapAtlas::MapAtlas(int size, int tiles) : size_(size), layout_(tiles, shadow_atlas_side / size) {
  texture_ = gl::Texture(gl::Format::depth32f, size * layout_.columns(), size * layout_.rows, layout_.layers);
  for (int i = 0; i < layout_.layers; ++i) layers_.emplace_back(texture_, i);
  views_.resize(static_cast<std::size_t>(tiles));
  fresh_.assign(static_cast<std::size_t>(tiles), unused);
  changed_.reserve(static_cast<std::size_t>(tiles));
}

std::size_t MapAtlas::bytes_of(int size, int tiles) {
  const TileLayout layout(tiles, shadow_atlas_side / size);
  return static_cast<std::size_t>(size * layout.columns()) * static_cast<std::size_t>(size * layout.rows) *
         static_cast<std::size_t>(layout.layers) * gl::bytes_per_texel(gl::Format::depth32f);
}

void MapAtlas::set_view(int tile, const MapView& view, bool used) {
  const auto t = static_cast<std::size_t>(tile);
  if (used && fresh_[t] == fresh && views_[t] == view) return;
  views_[t] = view;
  if (used && fresh_[t] == unwanted) return;
  stale_ -= fresh_[t] == stale;
  fresh_[t] = used ? stale : unused;
  stale_ += used;
}

void MapAtlas::want(int first, int count, bool wanted) {
  for (int tile = first; tile < first + count; ++tile) {
    auto& state = fresh_[tile];
    if (state == unused || wanted == (state != unwanted)) continue;
    stale_ -= state == stale;
    stale_ += wanted;
    state = wanted ? stale : unwanted;
  }
}

void MapAtlas::invalidate(const std::vector<scene::Bounds>& moved) {
  if (before_) before_->invalidate(moved);
  for (std::size_t t = 0; t < fresh_.size(); ++t) {
    if (fresh_[t] != fresh) continue;
    const bool seen = std::ranges::any_of(moved, [&](const auto& box) { return sees_box(views_[t], box); });
    if (seen) fresh_[t] = stale, ++stale_;
  }
}

void MapAtlas::invalidate_all() {
  before_.reset();
  redraw_all();
}

void MapAtlas::redraw_all() {
  for (auto& state : fresh_) {
    if (state == fresh) state = stale, ++stale_;
  }
}

void MapAtlas::keep(MapAtlas&& before) {
  // Where no frame was drawn in between, what there is to keep is still that of before
  MapAtlas& whole = before.before_ ? *before.before_ : before;
  if (whole.size_ == size_) before_ = std::make_unique<MapAtlas>(std::move(whole));
}

void MapAtlas::copy_kept() {
  const std::unique_ptr<MapAtlas> before = std::move(before_);
  if (!before || (glass_.id() && !(before->glass_.id() && before->glass_.format() == glass_.format())))
    return;
  const auto place = [&](const MapAtlas& atlas, const gl::Texture& texture, int tile) {
    return gl::LayerPlace{texture, atlas.layout_.layer(tile), atlas.layout_.column(tile) * size_,
                          atlas.layout_.row(tile) * size_};
  };
  const int most = before->count();
  int next = 0;  // lamps keep their order: most often the tile after the last one that was found
  for (int tile = 0; tile < count(); ++tile) {
    if (fresh_[tile] != stale) continue;
    const auto shows_it = [&](int from) {
      return before->fresh_[from] == fresh && before->views_[from] == views_[tile];
    };
    int looked_at = 0;
    while (looked_at < most && !shows_it((next + looked_at) % most)) ++looked_at;
    if (looked_at == most) continue;
    const int from = (next + looked_at) % most;
    next = from + 1;
    gl::copy_texels(place(*before, before->texture_, from), place(*this, texture_, tile), size_, size_);
    if (glass_.id())
      gl::copy_texels(place(*before, before->glass_, from), place(*this, glass_, tile), size_, size_);
    fresh_[tile] = fresh;
    --stale_;
    changed_.push_back(tile);
  }
}

void MapAtlas::begin_glass(bool absorbs) {
  // One crossing of a body may say more than 1
  const gl::Format format = absorbs ? gl::Format::rgba16f : gl::Format::rgba8;
  if (!texture_.id() || (glass_.id() && glass_.format() == format)) return;
  glass_layers_.clear();
  glass_ = gl::Texture(format, texture_.width(), texture_.height(), layout_.layers);
  glass_.set_filter(true);
  for (int i = 0; i < layout_.layers; ++i) glass_layers_.emplace_back(glass_, i);
  redraw_all();
}

int MapAtlas::update(const GpuScene& scene, gl::Program& opaque, gl::Program& alpha, int most, int& waiting,
                     FrameCounters& counters, gl::Program* glass) {
  changed_.clear();
  if (glass) begin_glass(scene.any_absorbs());
  copy_kept();
  int drawn = 0;
  for (std::size_t t = 0; t < fresh_.size() && stale_ > 0 && drawn < most; ++t) {
    if (fresh_[t] != stale) continue;
    draw_tile(static_cast<int>(t), scene, opaque, alpha, glass, counters);
    fresh_[t] = fresh;
    --stale_;
    ++drawn;
    changed_.push_back(static_cast<int>(t));
  }
  waiting += stale_;
  return drawn;
}

void MapAtlas::draw_tile(int tile, const GpuScene& scene, gl::Program& opaque, gl::Program& alpha,
                         gl::Program* glass, FrameCounters& counters) {
  const auto layer = static_cast<std::size_t>(layout_.layer(tile));
  const gl::Rect rect{layout_.column(tile) * size_, layout_.row(tile) * size_, size_, size_};
  gl::bind_framebuffer(layers_[layer].id(), rect);
  gl::apply({.depth = gl::Depth::test_and_write, .color_write = false});
  gl::clear_depth(rect, 0);

  // One texel at each edge lies beyond what the map stands for, so that filters find it there
  const MapView& view = views_[tile];
  const float shrink = static_cast<float>(size_ - 2) / static_cast<float>(size_);
  bool filters = false;
  const auto use = [&](gl::Program& program) {
    program.use();
    program.set("origin", view.origin);
    program.set("right", view.right * shrink);
    program.set("up", view.up * shrink);
    program.set("forward", view.forward);
    program.set("near_plane", view.near_plane);
  };
  const auto use_filtering = [&](gl::Program& program) {
    use(program);
    program.set("clear_radius", view.clear_radius);
    scene.begin(false);
  };
  const bool all_filter = view.clear_radius > 0;
  if (all_filter) {
    use_filtering(alpha);
  } else {
    use(opaque);
    scene.begin(true);
  }
  for (const DrawItem& item : scene.items()) {
    if (!sees_box(view, item.world)) continue;
    if (item.filters() && !filters && !all_filter) {
      filters = true;
      use_filtering(alpha);
    }
    scene.draw(item, item.filters() || all_filter, counters);
  }
  if (!glass) return;

  gl::bind_framebuffer(glass_layers_[layer].id(), rect);
  gl::clear_color(rect, 0, 1, 1, 1, 1);
  gl::apply({.blend = gl::Blend::multiply});
  texture_.bind(unit::light_maps);
  use_filtering(*glass);
  glass->set("layer", layout_.layer(tile));
  for (const DrawItem& item : scene.items())
    if (item.glass && sees_box(view, item.world)) scene.draw(item, true, counters);
}

}  // namespace ssphh::realtime
