#include "probes.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/core/require.h>

namespace ssphh::realtime {
namespace {

constexpr int largest_face = 256, smallest_face = 32;

/// The largest face of a power of two with which all probes' maps fit into `bytes`.
int face_size(std::size_t probes, std::size_t bytes) {
  int size = largest_face;
  while (size > smallest_face &&
         probes * 6 * static_cast<std::size_t>(size) * static_cast<std::size_t>(size) * 4 > bytes)
    size /= 2;
  return size;
}

/// The grid's lists as probe_places.glsl reads them: places, and probes' numbers, which floats hold exactly.
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
    : radiance_degree_(set.degree), near_(cube_near(bounds)), light_(probes::surface_light(set, params)) {
  scene::Bounds all = bounds;
  for (const probes::Probe& probe : set.probes) {
    places_.push_back(probe.position);
    radii_.push_back(probe.radius);
    all.add(probe.position);
  }
  spacing_ = params.weights.spacing > 0 ? params.weights.spacing : probes::median_spacing(places_);
  grid_ = probes::make_candidate_grid(places_, all, spacing_);
  cells_ = cell_texture(grid_, places_);
  irradiance_tiles_ = IrradianceTiles(probes::irradiance_degree(params, set.degree), params.dering);
  keeps_direct_ = set.surface && !set.surface->direct.empty();
  irradiance_ = TileAtlas(irradiance_tile, keeps_direct_ ? 2 * count() : count());
  radiance_ = TileAtlas(radiance_tile, 1);
  levels_ = glossy ? static_cast<int>(radiance_roughness.size()) : 1;
  counters.bytes_uploaded += cells_.bytes();

  irradiance_functions_.resize(light_.size() * irradiance_tiles_.count());
  upload_irradiance(all_probes(), counters);

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
  upload_irradiance(probes, counters);
  if (radiance_tiles_) upload_radiance(probes, counters);
  if (fitted_) fitted_->update(probes, irradiance_functions_, irradiance_tiles_.count(), *surface_, counters);
}

void Probes::set_light_of_moving(std::span<const sh::RadianceSh> light, FrameCounters& counters) {
  require(light.empty() || keeps_direct_, "probes", "they keep direct light that their set did not");
  has_light_of_moving_ = !light.empty();
  counters.bytes_uploaded += irradiance_.fill(
      light.size(), [&](std::size_t i) { return count() + static_cast<int>(i); },
      [&](std::size_t i, std::span<vec4> tile) { irradiance_tiles_.make(light[i], tile); }, texels_);
}

void Probes::set_fitted(const probes::FittedSurfaces& fitted, FrameCounters& counters) {
  fitted_.reset();
  surface_.reset();
  if (fitted.empty()) return;
  FittedLight light(fitted, count());
  surface_.emplace(fitted.surfaces, counters);
  fitted_ = std::move(light);
  fitted_->update(all_probes(), irradiance_functions_, irradiance_tiles_.count(), *surface_, counters);
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

void Probes::want_radiance(FrameCounters& counters) {
  if (radiance_tiles_ || count() == 0) return;
  radiance_tiles_.emplace(radiance_degree_, levels_);
  radiance_ = TileAtlas(radiance_tile, levels_ * count());
  upload_radiance(all_probes(), counters);
}

void Probes::upload_irradiance(std::span<const int> probes, FrameCounters& counters) {
  counters.bytes_uploaded += irradiance_.fill(
      probes.size(), [&](std::size_t i) { return probes[i]; },
      [&](std::size_t i, std::span<vec4> tile) {
        const sh::IrradianceSh e = irradiance_tiles_.make(light_[probes[i]], tile);
        std::ranges::copy(e.values, irradiance_functions_.begin() +
                                        static_cast<std::ptrdiff_t>(probes[i] * irradiance_tiles_.count()));
      },
      texels_);
}

void Probes::upload_radiance(std::span<const int> probes, FrameCounters& counters) {
  const auto levels = static_cast<std::size_t>(levels_);
  const auto level = [&](std::size_t i) { return static_cast<int>(i % levels); };
  counters.bytes_uploaded += radiance_.fill(
      levels * probes.size(), [&](std::size_t i) { return probes[i / levels] * levels_ + level(i); },
      [&](std::size_t i, std::span<vec4> tile) {
        radiance_tiles_->make(light_[probes[i / levels]], level(i), tile);
      },
      texels_);
}

int Probes::update_maps(const GpuScene& scene, gl::Program& opaque, gl::Program& alpha, int most,
                        int& waiting, FrameCounters& counters) {
  return maps_.update(scene, opaque, alpha, most, waiting, counters);
}

void Probes::bind_sight() const {
  maps_.texture().bind(unit::probe_maps);
  cells_.bind(unit::probe_cells);
}

void Probes::bind_lookup(gl::Program& program) const {
  bind_sight();
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
