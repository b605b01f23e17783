#include <algorithm>
#include <cmath>
#include <set>

#include <ssphh/core/parallel.h>
#include <ssphh/core/require.h>
#include <ssphh/probes/lookup_constants.h>
#include <ssphh/probes/surface_interpolation.h>
#include <ssphh/transport/fitted_weights.h>
#include <ssphh/transport/surface_gather.h>

#include "network_data.h"
#include "point_cells.h"
#include "unseen_surfaces.h"

namespace ssphh::transport {
namespace {

/// Beyond this share of its reach a point has next to no weight: where it is alone, it stands for places that
/// it knows nothing of.
constexpr float share_of_reach = 0.75f;

}  // namespace

/// Where records may stand: on still surfaces, in cubes of a grid.
class RecordPlaces {
 public:
  /// Within `box` alone. `everywhere`: also on surfaces that no surfel stands on.
  RecordPlaces(const TransportNetwork& network, const probes::TileBox& box, int most, bool everywhere)
      : source_(network.data_->source),
        surfel_sizes_(network.surfels()),
        box_(box),
        all_(surfel_points(network)),
        surfels_(all_.size()) {
    // As surfels do, records stand farther apart where probes are far
    for (const rays::SurfacePoint& point : all_) levels_.push_back(level_of(point));
    // Cubes too small for two surfels, however few there are, would not differ from larger ones
    const Group here = in_box(0, all_.size());
    const std::size_t count = here.points.size();
    const auto apart = static_cast<int>(std::min<std::size_t>(count - count / 10, most_records));
    if (count > 0) grid_ = finest_grid(here.points, here.levels, std::min(most, apart));
    // Surfels do stand within walls: light that slips through where two bodies meet finds them. Nobody looks
    // in there, and a record beside the wall's foot would lend its darkness to the floor before it
    within_ = within_bodies(all_, surfel_sizes_, source_);
    if (everywhere) add_unseen(network, most / 4);
    coarse_ = all_.size();
    add_patches(network);
  }

  /// First those of the network's still surfels, in their order; last those of the surfels' patches.
  const std::vector<rays::SurfacePoint>& all() const { return all_; }
  bool any() const {
    return std::ranges::any_of(all_, [&](const auto& p) { return has(p); });
  }
  std::size_t surfels() const { return surfels_; }
  bool is_patch(std::size_t place) const { return place >= coarse_; }

  /// Of each cube, `coarser` levels above its points' own, in which none of the chosen stands, the middle
  /// one. With `patches` one of those in each cube smaller than those levels that holds nothing else.
  std::vector<std::size_t> free(int coarser, bool patches) const {
    std::set<PointCell> taken;
    for (const std::size_t i : chosen_) taken.insert(grid_.cell(all_[i], levels_[i] + coarser));
    std::vector<std::size_t> result;
    const auto take_middles = [&](std::size_t first, std::size_t end) {
      Group places = in_box(first, end);
      for (int& level : places.levels) level += coarser;
      for (const auto& [cell, members] : grid_.sort(places.points, places.levels)) {
        if (!taken.insert(cell).second) continue;
        const std::size_t middle = places.index[middle_one(places.points, members)];
        if (!within_[middle]) result.push_back(middle);
      }
    };
    take_middles(0, coarse_);
    if (patches && coarser < 0) take_middles(coarse_, all_.size());
    std::ranges::sort(result);
    return result;
  }

  std::vector<rays::SurfacePoint> choose(std::span<const std::size_t> which) {
    chosen_.insert(chosen_.end(), which.begin(), which.end());
    std::vector<rays::SurfacePoint> points;
    for (const std::size_t i : which) points.push_back(all_[i]);
    return points;
  }

  /// Of the patches, or of all other places, those that no known point lights but from afar, at most so many,
  /// spread evenly.
  std::vector<rays::SurfacePoint> unlit(const probes::SurfaceInterpolation& known, bool patches,
                                        std::size_t most, const Control& control) const {
    const std::size_t first = patches ? coarse_ : 0, count = patches ? all_.size() - coarse_ : coarse_;
    std::vector<std::uint8_t> is(count);
    parallel_for(
        count, 64,
        [&](std::size_t i) {
          const rays::SurfacePoint& place = all_[first + i];
          if (within_[first + i] || !has(place)) return;
          probes::SurfaceShares storage;
          is[i] = std::ranges::none_of(known.at(place, storage), [&](const probes::SurfaceShare& share) {
            const float near = share_of_reach * probes::fitted_reach * known.spacing(share.point);
            return glm::distance(known.position(share.point), place.position) < near;
          });
        },
        control);
    std::vector<rays::SurfacePoint> points;
    std::vector<int> levels;
    for (std::size_t i = 0; i < count; ++i) {
      if (!is[i]) continue;
      points.push_back(all_[first + i]);
      levels.push_back(levels_[first + i]);
    }
    return points.empty() ? points : spread_points(points, static_cast<int>(most), levels);
  }

  /// Lookups between points, in the scene as posed.
  probes::SurfaceInterpolation between(std::span<const rays::SurfacePoint> points) const {
    return {points, [&source = source_](const vec3& a, const vec3& b) {
              return source.joined(0, {a, b - a, 1});
            }};
  }

 private:
  struct Group {
    std::vector<rays::SurfacePoint> points;
    std::vector<int> levels;
    std::vector<std::size_t> index;  ///< of all_
  };

  bool has(const rays::SurfacePoint& point) const { return box_.contains(point.position); }

  Group in_box(std::size_t first, std::size_t end) const {
    Group group;
    for (std::size_t i = first; i < end; ++i) {
      if (!has(all_[i])) continue;
      group.points.push_back(all_[i]);
      group.levels.push_back(levels_[i]);
      group.index.push_back(i);
    }
    return group;
  }

  /// Where surfels are coarse, lamps make finer ones, but no denser records: they would be missed elsewhere.
  int level_of(const rays::SurfacePoint& point) const {
    const SurfelSizes& sizes = surfel_sizes_.sizes();
    return sizes.grow() ? sizes.level_by_probes(point.position) : sizes.level(point.position);
  }

  /// Places that no surfel stands at are worth fewer points: their cubes are so large that at most so many
  /// hold any.
  void add_unseen(const TransportNetwork& network, int most) {
    const std::vector<rays::SurfacePoint> others = unseen_surfaces(network, source_, box_);
    if (others.empty()) return;
    if (!any()) grid_ = finest_grid(others, {}, std::max(most, 1));
    std::vector<int> levels;
    for (const rays::SurfacePoint& point : others) levels.push_back(level_of(point));
    while (grid_.sort(others, levels).size() > static_cast<std::size_t>(std::max(most, 1)))
      for (int& level : levels) ++level;
    all_.insert(all_.end(), others.begin(), others.end());
    levels_.insert(levels_.end(), levels.begin(), levels.end());
    within_.resize(all_.size());
  }

  void add_patches(const TransportNetwork& network) {
    std::vector<rays::SurfacePoint> patches = surfel_points(network, network.params().samples);
    std::erase_if(patches, [&](const rays::SurfacePoint& point) { return !has(point); });
    const std::vector<std::uint8_t> within = within_bodies(patches, surfel_sizes_, source_);
    all_.insert(all_.end(), patches.begin(), patches.end());
    within_.insert(within_.end(), within.begin(), within.end());
    for (const rays::SurfacePoint& point : patches) levels_.push_back(level_of(point));
  }

  const rays::TransportSource& source_;
  const SurfelSet& surfel_sizes_;
  probes::TileBox box_;
  std::vector<rays::SurfacePoint> all_;
  std::vector<std::uint8_t> within_;  ///< whether each lies within a body
  std::size_t surfels_, coarse_ = 0;  ///< of all_, that are surfels; that are not patches
  std::vector<int> levels_;
  PointGrid grid_{vec3(0), 1};
  std::vector<std::size_t> chosen_;
};

namespace {

/// Points that stand first, at most: a quarter as many may be too few to tell where more are wanted.
constexpr std::size_t first_points = 512;
/// What the points around a point may miss of its light, leaving it out doubles their distance.
constexpr float tolerance = 0.04f;
/// The same of the mean light: the dark may be less exact.
constexpr float tolerance_of_mean = 0.002f;

/// Halvings below an even spread of all points, where light alone asks for more: a plain takes most cubes of
/// that spread and few of its points.
constexpr int levels_below = 2;

/// What must be missed at a patch, in tolerances: where something touches the ground, a surfel is too large
/// to hold the dark below it.
constexpr float patch_doubt = 4;

/// What surfels got, by few rays and over all their extent, may be missed by so much.
constexpr float surfel_tolerance = 0.25f;
constexpr float surfel_tolerance_of_mean = 0.02f;

/// How far each point is from being known by those around it, by the points' light, and at `near_surfaces` by
/// how near those are: 1 where it just is.
std::vector<float> doubts(const SurfaceGather& gather, const probes::SurfaceInterpolation& known,
                          std::span<const probes::RecordLight> light, bool near_surfaces) {
  const std::vector<rays::SurfacePoint>& points = gather.points();
  double sum = 0;
  for (const probes::RecordLight& l : light) sum += static_cast<double>(max_component(l[3]));
  const float least = tolerance_of_mean * static_cast<float>(sum / static_cast<double>(points.size()));
  std::vector<float> result(points.size());
  parallel_for(points.size(), 64, [&](std::size_t i) {
    probes::SurfaceShares storage;
    const auto shares = known.at(points[i], storage, static_cast<std::uint32_t>(i));
    probes::RecordLight predicted(0);
    for (const probes::SurfaceShare& share : shares) predicted += share.weight * light[share.point];
    const vec3 e = light[i][3], missed = glm::abs(predicted * vec4(points[i].normal, 1) - e);
    const float allowed = tolerance * max_component(e) + least;
    const float of_light = shares.empty() ? 1 : allowed > 0 ? max_component(missed) / allowed : 0;
    result[i] = near_surfaces ? std::max(of_light, known.spacing(i) / gather.openness()[i]) : of_light;
  });
  return result;
}

/// The doubts of the points that light a place, by their weights; 1 where none does.
float doubt_at(const rays::SurfacePoint& place, const probes::SurfaceInterpolation& known,
               std::span<const float> doubts) {
  probes::SurfaceShares storage;
  float sum = 0, all = 0;
  for (const probes::SurfaceShare& share : known.at(place, storage)) {
    sum += std::abs(share.weight) * doubts[share.point];
    all += std::abs(share.weight);
  }
  return all > 0 ? sum / all : 1;
}

/// What surfels got of reflected light, beside what points would give them: points that are far apart know
/// nothing of a roof between them.
class SurfelDoubts {
 public:
  SurfelDoubts(const RecordPlaces& places, std::span<const Irradiance4> reflected,
               const probes::SurfaceInterpolation& known, std::span<const probes::RecordLight> light)
      : places_(places), reflected_(reflected), known_(known), light_(light) {
    double sum = 0;
    for (std::size_t i = 0; i < places.surfels(); ++i)
      sum += static_cast<double>(max_component(vec3(reflected[i])));
    least_ = surfel_tolerance_of_mean * static_cast<float>(sum / static_cast<double>(places.surfels()));
  }

  /// Of a place: 1 where it just is within what may be missed; 0 where no surfel or no point tells.
  float at(std::size_t place) const {
    vec3 predicted;
    if (place >= places_.surfels() || !known_.irradiance(places_.all()[place], light_, predicted)) return 0;
    const vec3 got(reflected_[place]);
    const float allowed = surfel_tolerance * max_component(glm::max(got, predicted)) + least_;
    return allowed > 0 ? max_component(glm::abs(predicted - got)) / allowed : 0;
  }

 private:
  const RecordPlaces& places_;
  std::span<const Irradiance4> reflected_;
  const probes::SurfaceInterpolation& known_;
  std::span<const probes::RecordLight> light_;
  float least_ = 0;
};

/// Those of `which` of which `doubt` is 1 at least; the most doubtful `most`.
template <class Doubt>
std::vector<std::size_t> doubtful(std::span<const std::size_t> which, std::size_t most,
                                  const Control& control, const Doubt& doubt) {
  std::vector<float> doubts(which.size());
  parallel_for(
      which.size(), 64, [&](std::size_t i) { doubts[i] = doubt(which[i]); }, control);
  std::vector<std::pair<float, std::size_t>> found;
  for (std::size_t i = 0; i < which.size(); ++i) {
    if (doubts[i] >= 1) found.emplace_back(-doubts[i], which[i]);
  }
  std::ranges::sort(found);
  if (found.size() > most) found.resize(most);
  std::vector<std::size_t> result;
  for (const auto& [doubt_of, place] : found) result.push_back(place);
  std::ranges::sort(result);
  return result;
}

}  // namespace

std::unique_ptr<SurfaceGather> gather_where_needed(const TransportNetwork& network,
                                                   const GatherParams& params, std::span<const float> times,
                                                   const LightOfPose& light_at, const Control& control,
                                                   const AddRecordLight& add_more) {
  require(!times.empty() && light_at != nullptr, "surface records",
          "there is no pose to look at, or nothing tells its light");
  const auto light_in = [&](float time) {
    PosedIrradiance light = light_at(time);
    require(light.reflected.size() == network.surfel_count(), "surface records",
            "there is not the reflected light of each surfel");
    return light;
  };
  PosedIrradiance now = light_in(times[0]);
  RecordPlaces places(network, params.within, params.points, !params.baked.empty());
  const auto gather_at = [&](std::vector<rays::SurfacePoint> points) {
    return SurfaceGather(network, std::move(points), params.rays, now.direct, control);
  };
  int first = 0;
  std::vector<std::size_t> wanted;
  if (places.any()) wanted = places.free(first, false);
  while (wanted.size() > first_points) wanted = places.free(++first, false);
  auto gather = std::make_unique<SurfaceGather>(gather_at(places.choose(wanted)));
  std::vector<probes::RecordLight> light;
  // Rays of those at a door's rims would be asked again in every frame
  const bool with_patches = times.size() == 1;
  for (std::size_t pose = 0; pose < times.size(); ++pose) {
    if (pose > 0) {
      now = light_in(times[pose]);
      gather->update_pose();
    }
    for (int coarser = first - 1; coarser >= -levels_below; --coarser) {
      const std::size_t count = gather->points().size(), points = static_cast<std::size_t>(params.points);
      const std::size_t room = coarser >= 0 ? most_records - count : points - std::min(count, points);
      if (room == 0) break;
      const probes::SurfaceInterpolation known = places.between(gather->points());
      gather->light(now.lit, light);
      std::vector<float> doubt = doubts(*gather, known, light, coarser >= 0);
      const std::vector<probes::RecordLight> reflected = light;
      if (add_more && pose == 0) {
        // What is brighter hides how the light of other groups changes: either asks for points.
        add_more(gather->points(), light);
        const std::vector<float> of_all = doubts(*gather, known, light, coarser >= 0);
        for (std::size_t i = 0; i < doubt.size(); ++i) doubt[i] = std::max(doubt[i], of_all[i]);
      }
      const SurfelDoubts by_surfels(places, now.reflected, known, reflected);
      wanted = doubtful(places.free(coarser, with_patches), room, control, [&](std::size_t place) {
        const float by_points =
            doubt_at(places.all()[place], known, doubt) / (places.is_patch(place) ? patch_doubt : 1);
        return by_points >= 1 ? by_points : by_surfels.at(place);
      });
      if (!wanted.empty()) gather->append(gather_at(places.choose(wanted)));
    }
  }

  // Then where surfels, and their patches, see none of these: pockets between the points of surfels. Where
  // more stand, each reaches less far: so surfels are asked again
  const std::size_t most = std::min(2 * gather->points().size(), most_records);
  for (const bool patches : {false, true, false, false}) {
    if (gather->points().size() >= most) break;
    const std::vector<rays::SurfacePoint> unlit =
        places.unlit(places.between(gather->points()), patches, most - gather->points().size(), control);
    if (!unlit.empty()) gather->append(gather_at(unlit));
  }
  return gather;
}

}  // namespace ssphh::transport
