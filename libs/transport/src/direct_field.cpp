#include <algorithm>

#include <ssphh/core/parallel.h>
#include <ssphh/core/require.h>
#include <ssphh/transport/direct_field.h>

namespace ssphh::transport {

DirectField::DirectField(const TransportNetwork& network, std::size_t group_count)
    : network_(network), groups_(group_count, std::vector<vec3>(network.samples().size(), vec3(0))) {}

void DirectField::require_group(int group) const {
  require(group >= 0 && static_cast<std::size_t>(group) < groups_.size(), "light group",
          "there is none of that index");
}

std::size_t DirectField::update_all(int group, const rays::DirectLight& light) {
  const std::size_t count = choose_all(group);
  find(group, light, 0, count);
  return count;
}

std::size_t DirectField::update_moved(int group, const rays::DirectLight& light,
                                      std::span<const scene::Bounds> moved) {
  const std::size_t count = choose_moved(group, light, moved);
  find(group, light, 0, count);
  return count;
}

std::size_t DirectField::choose_all(int group) {
  require_group(group);
  which_.clear();
  for (std::size_t i = 0; i < network_.samples().size(); ++i) {
    if (network_.sample_exists(i)) which_.push_back(static_cast<std::uint32_t>(i));
  }
  return which_.size();
}

std::size_t DirectField::choose_moved(int group, const rays::DirectLight& light,
                                      std::span<const scene::Bounds> moved) {
  require_group(group);
  const auto samples = static_cast<std::size_t>(network_.params().samples);
  const std::vector<Surfel>& surfels = network_.surfels().surfels();
  touched_.assign(network_.samples().size(), 0);
  parallel_for(touched_.size(), 2048, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!network_.sample_exists(i)) continue;
      touched_[i] =
          surfels[i / samples].part > 0 || std::ranges::any_of(moved, [&](const scene::Bounds& box) {
            return light.may_shadow(group, network_.samples()[i], box);
          });
    }
  });
  which_.clear();
  for (std::size_t i = 0; i < touched_.size(); ++i) {
    if (touched_[i]) which_.push_back(static_cast<std::uint32_t>(i));
  }
  return which_.size();
}

void DirectField::find(int group, const rays::DirectLight& light, std::size_t begin, std::size_t end) {
  require_group(group);
  require(begin <= end && end <= which_.size(), "direct light", "so many samples were not chosen");
  points_.resize(end - begin);
  values_.resize(end - begin);
  for (std::size_t k = begin; k < end; ++k) points_[k - begin] = network_.samples()[which_[k]];
  light.irradiance(group, points_, values_);
  if (light.mirrors()) {
    mirrored_.resize(end - begin);
    light.mirrored(group, points_, mirrored_);
    for (std::size_t k = 0; k < mirrored_.size(); ++k) values_[k] += mirrored_[k];
  }
  require(std::ranges::all_of(values_, is_finite), "transport source", "its direct light is not finite");
  std::vector<vec3>& field = groups_[group];
  for (std::size_t k = begin; k < end; ++k) field[which_[k]] = values_[k - begin];
}

void DirectField::sum(std::span<const vec3> group_scales, std::span<const vec3> extra,
                      std::vector<Irradiance4>& out) const {
  require(group_scales.size() == groups_.size(), "direct light", "there is not one factor for each group");
  require(extra.empty() || extra.size() == network_.samples().size(), "direct light",
          "what is added is not one colour for each sample");
  const auto samples = static_cast<std::size_t>(network_.params().samples);
  const std::vector<std::uint8_t>& used = network_.sample_used();
  out.resize(network_.patch_count());
  parallel_for(network_.surfel_count(), 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s) {
      vec3 total(0);
      float count = 0;
      for (std::size_t i = s * samples; i < (s + 1) * samples; ++i) {
        if (!used[i]) continue;
        vec3 here(0);
        for (std::size_t g = 0; g < groups_.size(); ++g) here += group_scales[g] * groups_[g][i];
        if (!extra.empty()) here += extra[i];
        out[i] = vec4(here, 0);
        total += here;
        ++count;
      }
      const vec4 mean(total / std::max(count, 1.0f), 0);
      for (std::size_t i = s * samples; i < (s + 1) * samples; ++i) {
        if (!used[i]) out[i] = mean;
      }
    }
  });
}

}  // namespace ssphh::transport
