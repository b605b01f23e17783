#include "probes.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/core/parallel.h>
#include <ssphh/core/require.h>
#include <ssphh/sh/irradiance.h>
#include <ssphh/sh/window.h>
#include <ssphh/sh/zonal.h>

namespace ssphh::realtime {
namespace {

/// Texels of a tile's side. The tests bound what interpolation errs in each band; irradiance has little of
/// the higher ones, and so has what a rough surface mirrors.
constexpr int irradiance_tile = 24, radiance_tile = 30;
constexpr int largest_face = 256, smallest_face = 32;

constexpr std::array<float, sh::max_degree + 1> ones = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};

/// The largest face of a power of two with which all probes' maps fit into `bytes`.
int face_size(std::size_t probes, std::size_t bytes) {
  int size = largest_face;
  while (size > smallest_face &&
         probes * 6 * static_cast<std::size_t>(size) * static_cast<std::size_t>(size) * 4 > bytes)
    size /= 2;
  return size;
}

/// The grid's lists as probe_lookup.glsl reads them: places, and probes' numbers, which floats hold exactly.
gl::Texture cell_texture(const probes::CandidateGrid& grid, std::span<const vec3> places) {
  constexpr std::size_t width = list_width;
  std::vector<vec4> texels((grid.lists.size() + width - 1) / width * width, vec4(0, 0, 0, -1));
  for (std::size_t i = 0; i < grid.lists.size(); ++i) {
    const int probe = grid.lists[i];
    if (probe >= 0) texels[i] = vec4(places[probe], static_cast<float>(probe));
  }
  gl::Texture texture(gl::Format::rgba32f, width, static_cast<int>(texels.size() / width));
  texture.upload(std::as_bytes(std::span(texels)));
  return texture;
}

}  // namespace

Probes::Probes() {
  cells_ = gl::Texture(gl::Format::rgba32f, 1, 1);
  irradiance_ = TileAtlas(irradiance_tile, 1);
  radiance_ = TileAtlas(radiance_tile, 1);
  maps_ = MapAtlas(smallest_face, 1);
}

Probes::Probes(const probes::ProbeSet& set, const probes::LookupParams& params,
               const RendererParams& renderer, const scene::Bounds& bounds, bool glossy,
               FrameCounters& counters)
    : irradiance_degree_(probes::irradiance_degree(params, set.degree)),
      radiance_degree_(set.degree),
      dering_(params.dering),
      near_(cube_near(bounds)),
      light_(probes::surface_light(set, params)) {
  scene::Bounds all = bounds;
  for (const probes::Probe& probe : set.probes) {
    places_.push_back(probe.position);
    radii_.push_back(probe.radius);
    all.add(probe.position);
  }
  spacing_ = params.weights.spacing > 0 ? params.weights.spacing : probes::median_spacing(places_);
  grid_ = probes::make_candidate_grid(places_, all, spacing_);
  cells_ = cell_texture(grid_, places_);
  irradiance_basis_ = TileBasis(irradiance_tile, irradiance_degree_);
  keeps_direct_ = set.surface && !set.surface->direct.empty();
  irradiance_ = TileAtlas(irradiance_tile, keeps_direct_ ? 2 * count() : count());
  radiance_ = TileAtlas(radiance_tile, 1);
  levels_ = glossy ? static_cast<int>(radiance_roughness.size()) : 1;
  counters.bytes_uploaded += cells_.bytes();

  irradiance_functions_.resize(light_.size() * irradiance_count());
  make_tiles(all_probes(), true, false, counters);

  maps_ = MapAtlas(face_size(places_.size(), renderer.probe_map_bytes), 6 * count());
  const std::vector<float> reach = probes::probe_reach(grid_, places_);
  for (int i = 0; i < count(); ++i) place_maps(i, reach[i]);
}

void Probes::place_maps(int probe, float reach) {
  for (int face = 0; face < 6; ++face)
    maps_.set_view(6 * probe + face, cube_view(position(probe), face, near_, reach));
}

void Probes::see_all(int probe) {
  if (sees_all_.empty()) sees_all_.assign(places_.size(), 0);
  unsigned char& known = sees_all_[probe];
  if (!known) place_maps(probe, std::numeric_limits<float>::infinity());
  known = 1;
}

void Probes::set_light(std::span<const int> probes, std::span<const sh::RadianceSh> light,
                       FrameCounters& counters) {
  const auto coefficients = static_cast<std::size_t>(sh::coefficient_count(radiance_degree_));
  for (std::size_t i = 0; i < probes.size(); ++i) {
    if (probes[i] < 0 || probes[i] >= count())
      throw Error(fmt::format("probe {}", probes[i]), fmt::format("there are {}", count()));
    if (light[i].values.size() != coefficients)
      throw Error(fmt::format("probe {}", probes[i]),
                  fmt::format("has {} RGB coefficients; the set's degree has {}", light[i].values.size(),
                              coefficients));
    if (!std::ranges::all_of(light[i].values, is_finite))
      throw Error(fmt::format("probe {}", probes[i]), "its light is not finite");
  }
  for (std::size_t i = 0; i < probes.size(); ++i) light_[probes[i]] = light[i];
  make_tiles(probes, true, has_radiance_, counters);
  if (fitted_) fitted_->update(probes, irradiance_functions_, irradiance_count(), *surface_, counters);
}

void Probes::set_light_of_moving(std::span<const sh::RadianceSh> light, FrameCounters& counters) {
  require(light.empty() || keeps_direct_, "probes", "they keep direct light that their set did not");
  has_light_of_moving_ = !light.empty();
  std::vector<vec4> tile(irradiance_basis_.texels());
  for (std::size_t i = 0; i < light.size(); ++i) {
    sh::RadianceSh l = light[i];
    l.values.resize(irradiance_count(), vec3(0));
    if (dering_) l = sh::dering(l, sh::NonNegative::irradiance);
    irradiance_basis_.evaluate(sh::irradiance_from_radiance(l).values, ones, tile);
    irradiance_.upload(count() + static_cast<int>(i), tile);
    counters.bytes_uploaded += tile.size() * sizeof(vec4);
  }
}

void Probes::set_fitted(const probes::FittedSurfaces& fitted, FrameCounters& counters) {
  fitted_.reset();
  surface_.reset();
  if (fitted.empty()) return;
  FittedLight light(fitted, count());
  surface_.emplace(fitted.surfaces, counters);
  fitted_ = std::move(light);
  fitted_->update(all_probes(), irradiance_functions_, irradiance_count(), *surface_, counters);
}

void Probes::set_records(const probes::SurfaceLists& lists, FrameCounters& counters) {
  fitted_.reset();
  surface_.reset();
  if (lists.empty()) return;
  surface_.emplace(lists, counters);
  set_record_light(std::vector(lists.points.size(), probes::RecordLight(0)), counters);
}

void Probes::set_record_light(std::span<const probes::RecordLight> light, FrameCounters& counters) {
  const std::size_t records = has_records() ? surface_->count() : 0;
  if (light.size() != records)
    throw Error("surface records", fmt::format("{} lights for {} records", light.size(), records));
  std::vector<std::uint32_t> all(records);
  std::iota(all.begin(), all.end(), 0u);
  if (records == 0) return;
  // E(n) = light · (n, 1) as bands 0 and 1.
  surface_->update(
      all,
      [&](std::uint32_t i) {
        SurfaceLight::Coefficients c{};
        c[0] = light[i][3] / 0.28209479f;
        for (const int k : {1, 2, 3}) c[k] = light[i][k % 3] / 0.48860251f;
        return c;
      },
      counters);
}

std::vector<int> Probes::all_probes() const {
  std::vector<int> all(places_.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

std::size_t Probes::irradiance_count() const {
  return static_cast<std::size_t>(sh::coefficient_count(irradiance_degree_));
}

void Probes::want_radiance(FrameCounters& counters) {
  if (has_radiance_ || count() == 0) return;
  has_radiance_ = true;
  radiance_basis_ = TileBasis(radiance_tile, radiance_degree_);
  radiance_ = TileAtlas(radiance_tile, levels_ * count());
  make_tiles(all_probes(), false, true, counters);
}

void Probes::make_tiles(std::span<const int> probes, bool irradiance, bool radiance,
                        FrameCounters& counters) {
  const std::size_t small = irradiance ? irradiance_basis_.texels() : 0;
  const std::size_t large = radiance ? radiance_basis_.texels() : 0;
  const std::size_t each = small + static_cast<std::size_t>(levels_) * large;
  // In portions, so that many probes need no more memory than a few
  constexpr std::size_t portion = 64;
  for (std::size_t first = 0; first < probes.size(); first += portion) {
    const std::size_t n = std::min(portion, probes.size() - first);
    if (texels_.size() < n * each) texels_.resize(n * each);
    const auto tile = [&](std::size_t i, std::size_t level) {
      return std::span<vec4>(texels_.data() + i * each + small + level * large, large);
    };
    parallel_for(n, 4, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        sh::RadianceSh l = light_[probes[first + i]];
        for (std::size_t r = 0; radiance && r < static_cast<std::size_t>(levels_); ++r)
          radiance_basis_.evaluate(l.values, sh::glossy_band_scales(radiance_roughness[r]), tile(i, r));
        if (!irradiance) continue;
        l.values.resize(irradiance_count(), vec3(0));
        if (dering_) l = sh::dering(l, sh::NonNegative::irradiance);
        const sh::IrradianceSh e = sh::irradiance_from_radiance(l);
        irradiance_basis_.evaluate(e.values, ones, std::span<vec4>(texels_.data() + i * each, small));
        std::copy_n(e.values.begin(), irradiance_count(),
                    irradiance_functions_.begin() +
                        static_cast<std::ptrdiff_t>(static_cast<std::size_t>(probes[first + i]) *
                                                    irradiance_count()));
      }
    });
    for (std::size_t i = 0; i < n; ++i) {
      const int probe = probes[first + i];
      if (irradiance) irradiance_.upload(probe, std::span<const vec4>(texels_.data() + i * each, small));
      for (std::size_t r = 0; radiance && r < static_cast<std::size_t>(levels_); ++r)
        radiance_.upload(probe * levels_ + static_cast<int>(r), tile(i, r));
      counters.bytes_uploaded += each * sizeof(vec4);
    }
  }
}

int Probes::update_maps(const GpuScene& scene, gl::Program& opaque, gl::Program& alpha, int most,
                        int& waiting, FrameCounters& counters) {
  return maps_.update(scene, opaque, alpha, most, waiting, counters);
}

void Probes::bind_sight() const {
  maps_.texture().bind(unit::probe_maps);
}

void Probes::bind_lookup(gl::Program& program) const {
  bind_sight();
  cells_.bind(unit::probe_cells);
  irradiance_.bind(unit::irradiance_tiles);
  radiance_.bind(unit::radiance_tiles);
  const bool of_moving = has_light_of_moving_ && uses_light_of_moving_;
  program.set("irradiance_layout", irradiance_.size(), irradiance_.layout().columns_log2,
              of_moving ? count() : 0);
  program.set("radiance_layout", radiance_.size(), radiance_.layout().columns_log2, levels_);
  program.set("level_roughness", std::span<const float>(radiance_roughness));
  if (surface_) surface_->bind(program);
}

std::size_t Probes::bytes() const {
  return maps_.bytes() + irradiance_.bytes() + radiance_.bytes() + cells_.bytes() +
         (surface_ ? surface_->bytes() : 0);
}

}  // namespace ssphh::realtime
