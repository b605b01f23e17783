#include "probes.h"

#include <algorithm>
#include <cmath>

#include <ssphh/core/error.h>
#include <ssphh/core/parallel.h>
#include <ssphh/sh/irradiance.h>
#include <ssphh/sh/window.h>

namespace ssphh::realtime {
namespace {

constexpr int emission_floats = 3 * sh::max_coefficient_count;
constexpr int largest_face = 256, smallest_face = 32;

/// What of a probe lights surfaces.
sh::RadianceSh chosen_light(const gi::ProbeSet& set, std::size_t i, gi::ProbeLayer layer,
                            gi::ProbeLight light) {
  const gi::Probe& probe = set.probes[i];
  if (layer == gi::ProbeLayer::neighbor) return set.hierarchy->neighbor[i];
  sh::RadianceSh own = light == gi::ProbeLight::reflected ? probe.reflected : probe.self;
  if (layer == gi::ProbeLayer::sum) own += set.hierarchy->neighbor[i];
  return own;
}

/// The largest face of a power of two with which all probes' maps fit into `bytes`.
int face_size(std::size_t probes, std::size_t bytes) {
  int size = largest_face;
  while (size > smallest_face &&
         probes * 6 * static_cast<std::size_t>(size) * static_cast<std::size_t>(size) * 4 > bytes)
    size /= 2;
  return size;
}

}  // namespace

Probes::Probes() {
  for (gl::Buffer* b : {&place_buffer_, &irradiance_, &radiance_, &grid_buffer_, &emission_})
    *b = gl::Buffer(16);
  maps_ = MapAtlas(smallest_face, 1);
}

Probes::Probes(const gi::ProbeSet& set, const gi::LookupParams& params, const RendererParams& renderer,
               const scene::Bounds& bounds, FrameCounters& counters)
    : irradiance_degree_(std::clamp(params.irradiance_degree, 0, std::min(set.degree, 4))),
      radiance_degree_(set.degree),
      dering_(params.dering),
      near_(std::max(5e-4f * bounds.radius(), 1e-6f)) {
  if (set.probes.empty()) throw Error("probe lookup", "the probe set is empty", "bake a scene with SPHLs");
  const gi::ProbeLayer layer =
      params.layer.value_or(set.hierarchy ? gi::ProbeLayer::sum : gi::ProbeLayer::self);
  if (layer != gi::ProbeLayer::self && !set.hierarchy)
    throw Error("probe lookup", "the probe set has no hierarchy", "run `ssphh hier` on the file first");

  scene::Bounds all = bounds;
  std::vector<vec4> places;
  for (const gi::Probe& probe : set.probes) {
    places_.push_back(probe.position);
    places.emplace_back(probe.position, probe.radius);
    all.add(probe.position);
  }
  spacing_ = params.weights.spacing > 0 ? params.weights.spacing : gi::median_spacing(places_);
  grid_ = make_probe_grid(places_, all, spacing_);
  place_buffer_ = gl::Buffer(std::span<const vec4>(places));
  grid_buffer_ = gl::Buffer(std::span<const int>(grid_.lists));
  const auto floats = [&](int degree) {
    return places_.size() * 3 * static_cast<std::size_t>(sh::coefficient_count(degree)) * sizeof(float);
  };
  irradiance_ = gl::Buffer(floats(irradiance_degree_));
  radiance_ = gl::Buffer(floats(radiance_degree_));
  emission_ = gl::Buffer(16);
  counters.bytes_uploaded += place_buffer_.size() + grid_buffer_.size();

  std::vector<int> indices;
  std::vector<sh::RadianceSh> light;
  for (std::size_t i = 0; i < set.probes.size(); ++i) {
    indices.push_back(static_cast<int>(i));
    light.push_back(chosen_light(set, i, layer, params.light));
  }
  set_light(indices, light, counters);

  maps_ = MapAtlas(face_size(places_.size(), renderer.probe_map_bytes), 6 * count());
  for (int i = 0; i < count(); ++i) {
    for (int face = 0; face < 6; ++face) maps_.set_view(6 * i + face, cube_view(position(i), face, near_));
  }
}

void Probes::set_light(std::span<const int> probes, std::span<const sh::RadianceSh> light,
                       FrameCounters& counters) {
  const auto e_count = static_cast<std::size_t>(sh::coefficient_count(irradiance_degree_));
  const auto l_count = static_cast<std::size_t>(sh::coefficient_count(radiance_degree_));
  // Irradiance first, then radiance, probe after probe
  const std::size_t row = 3 * (e_count + l_count);
  row_.assign(std::max(row_.size(), probes.size() * row), 0.0f);
  parallel_for(probes.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      sh::RadianceSh l = light[i];
      l.values.resize(l_count, vec3(0));
      float* out = row_.data() + i * row;
      for (std::size_t k = 0; k < l_count; ++k)
        for (int c = 0; c < 3; ++c) out[3 * (e_count + k) + static_cast<std::size_t>(c)] = l.values[k][c];
      l.values.resize(e_count);
      if (dering_) l = sh::dering(l, sh::NonNegative::irradiance);
      const sh::IrradianceSh e = sh::irradiance_from_radiance(l);
      for (std::size_t k = 0; k < e_count; ++k)
        for (int c = 0; c < 3; ++c) out[3 * k + static_cast<std::size_t>(c)] = e.values[k][c];
    }
  });
  for (std::size_t i = 0; i < probes.size(); ++i) {
    const auto p = static_cast<std::size_t>(probes[i]);
    const std::span<const float> values(row_.data() + i * row, row);
    upload(counters, irradiance_, values.first(3 * e_count), p * 3 * e_count);
    upload(counters, radiance_, values.subspan(3 * e_count), p * 3 * l_count);
  }
}

void Probes::set_emission(int probe, const sh::RadianceSh& leaving, FrameCounters& counters) {
  if (emission_.size() <= 16) {
    emission_ = gl::Buffer(places_.size() * emission_floats * sizeof(float));
    counters.bytes_uploaded += emission_.size();
  }
  std::array<float, emission_floats> row{};
  for (std::size_t k = 0; k < std::min<std::size_t>(leaving.values.size(), sh::max_coefficient_count); ++k)
    for (int c = 0; c < 3; ++c) row[3 * k + static_cast<std::size_t>(c)] = leaving.values[k][c];
  upload(counters, emission_, std::span<const float>(row), static_cast<std::size_t>(probe) * emission_floats);
}

int Probes::update_maps(const GpuScene& scene, gl::Program& opaque, gl::Program& alpha, int most,
                        int& waiting, FrameCounters& counters) {
  return maps_.update(scene, opaque, alpha, most, waiting, counters);
}

void Probes::bind() const {
  place_buffer_.bind_storage(binding::probe_places);
  irradiance_.bind_storage(binding::probe_irradiance);
  radiance_.bind_storage(binding::probe_radiance);
  grid_buffer_.bind_storage(binding::probe_grid);
  emission_.bind_storage(binding::probe_emission);
  maps_.texture().bind(unit::probe_maps);
}

std::size_t Probes::bytes() const {
  return maps_.bytes() + place_buffer_.size() + irradiance_.size() + radiance_.size() + grid_buffer_.size() +
         emission_.size();
}

}  // namespace ssphh::realtime
