#include "probe_volume.h"

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/place/place.h>
#include <ssphh/scene/probe_place.h>
#include <ssphh/transport/network.h>

#include "network_memory.h"
#include "probe_places.h"

namespace ssphh::methods::probe_volume {
namespace {

/// How light is found between probes.
enum class Interpolation { tetrahedra, trilinear };
constexpr auto enum_table(Interpolation) {
  using enum Interpolation;
  return std::to_array<EnumName<Interpolation>>({{tetrahedra, "tetrahedra"}, {trilinear, "trilinear"}});
}

std::vector<scene::ProbePlace> manual_places(const place::PlaceParams& params) {
  if (params.manual.empty())
    throw Error("light probes", "the scene has no SPHLs of its own", "let places=auto find some");
  return params.manual;
}

std::vector<scene::ProbePlace> grid_places(const ProbeGrid& grid) {
  std::vector<scene::ProbePlace> places;
  for (std::size_t i = 0; i < grid.positions.size(); ++i)
    places.push_back({fmt::format("grid {}", i), grid.positions[i]});
  return places;
}

ProbeGrid grid_of(const MethodScene& scene, const place::PlaceParams& seen, const MethodParameters& p,
                  const Control& control) {
  ProbeGridParams params;
  params.spacing = static_cast<float>(p.number("spacing"));
  if (p.integer("probes") > 0) params.places = p.integer("probes");
  params.interest = seen.interest;
  for (const scene::ProbePlace& place : seen.manual) params.interest.push_back(place.position);
  return make_probe_grid(scene.source, params, control);
}

std::vector<scene::ProbePlace> found_places(const MethodScene& scene, place::PlaceParams params,
                                            const MethodParameters& p, const Control& control) {
  params.spacing = static_cast<float>(p.number("spacing"));
  params.count = p.integer("probes");
  return scene::places_of(place::place_probes(scene.source, params, control).probes);
}

}  // namespace

probes::ProbeWeights VolumeWeights::at(const vec3& position) const {
  if (const auto* grid = std::get_if<GridWeights>(&by_)) return grid->at(position);
  probes::ProbeWeights out;
  const geometry::CornerWeights corners = std::get<geometry::Tetrahedra>(by_).at(position);
  for (const geometry::CornerWeight& corner : corners.used()) out.add(corner.point, corner.weight);
  return out;
}

std::size_t VolumeWeights::bytes() const {
  return std::visit([](const auto& by) { return by.bytes(); }, by_);
}

std::size_t VolumeWeights::cell_count() const {
  return tetrahedra() ? tetrahedra()->cells().size() : 0;
}

ProbeVolume::ProbeVolume(const MethodScene& scene, const MethodParameters& p, int degree,
                         const Control& control)
    : environment_group_(scene.source.environment_group()) {
  const place::PlaceParams seen = place::place_params(scene.scene);
  const bool trilinear = p.choice<Interpolation>("interpolation") == Interpolation::trilinear;
  std::vector<scene::ProbePlace> places;
  if (probe_places(p) == ProbePlaces::grid) {
    const ProbeGrid grid = grid_of(scene, seen, p, control);
    places = grid_places(grid);
    if (trilinear) weights_ = std::make_shared<const VolumeWeights>(grid);
  } else {
    if (trilinear)
      throw Error("light probes", "interpolation=trilinear needs probes on a grid",
                  "add places=grid, or interpolate within tetrahedra");
    places =
        probe_places(p) == ProbePlaces::scene ? manual_places(seen) : found_places(scene, seen, p, control);
  }
  const std::vector<vec3> positions = scene::positions_of(places);
  if (!weights_) weights_ = std::make_shared<const VolumeWeights>(positions);
  spacing_ = probes::median_spacing(positions);

  transport::RelightParams params;
  params.degree = degree;
  params.transport.surfel_size = static_cast<float>(p.number("surfel_size"));
  params.transport.directions = p.integer("directions");
  session_ =
      std::make_unique<transport::RelightSession>(scene.source, std::move(places), params, 0.0f, control);
}

void ProbeVolume::update(const scene::LightingState& state, int dark, const Control& control) {
  state_ = state;
  state_.emission.clear();
  if (dark >= 0) {
    state_.group_scales[dark] = vec3(0);
    // What does not light the probes need not be found anew for them
    if (dark == environment_group_) {
      state_.environment_rotation = session_->lighting().environment_rotation;
      state_.environment_image = session_->lighting().environment_image;
    }
  }
  session_->update(state_, control);
}

sketch::Sketch ProbeVolume::drawing(Drawing what) const {
  if (what == Drawing::surfels) return surfels_drawing(session_->network());
  if (what == Drawing::links) return links_drawing(session_->network());
  if (what != Drawing::tetrahedra || weights_->tetrahedra() == nullptr) return {};
  return tetrahedra_drawing(*weights_->tetrahedra(), scene::positions_of(places()));
}

MethodMemory ProbeVolume::memory() const {
  const std::size_t coefficients = radiance().empty() ? 0 : radiance().front().values.size();
  return {weights_->bytes() + places().size() * coefficients * sizeof(vec3),
          network_bytes(session_->network())};
}

MethodNumbers ProbeVolume::numbers() const {
  return {{"probes", static_cast<double>(places().size())},
          {"tetrahedra", static_cast<double>(weights_->cell_count())},
          {"surfels", static_cast<double>(session_->network().surfel_count())}};
}

std::vector<MethodParameter> probe_volume_parameters() {
  return {
      places_parameter({ProbePlaces::found, ProbePlaces::scene, ProbePlaces::grid},
                       "of the probes: found, the scene's own SPHLs, or a regular grid"),
      {"spacing", 0, 0, 1e4, "between probes that are placed [m]; 0: some 100 to 200 probes"},
      {"probes", 0, 0, 4096, "so many are placed, places of a grid counted; 0: as the spacing gives", true},
      choice_parameter("interpolation", Interpolation::tetrahedra,
                       "between the probes; trilinear on a grid only"),
      {"surfel_size", 0, 0, 1e3, "edge of a surfel [m]; 0: by the scene's radius and the probes' distance"},
      {"directions", 384, 16, 65536, "rays of a probe", true}};
}

}  // namespace ssphh::methods::probe_volume
