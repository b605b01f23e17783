#include "pane_light.h"

#include <algorithm>
#include <numeric>

#include <ssphh/core/parallel.h>

#include "probe_light.h"

namespace ssphh::transport {
namespace {

/// Per emitter and pane, at a probe.
constexpr int probe_samples = 256;

// What the first piece takes where there is little time.
constexpr std::size_t least = 16;

}  // namespace

RecordDirect records_by_panes(const rays::DirectLight& light, std::size_t groups) {
  std::vector<int> all(light.mirrors() ? groups : 0);
  std::iota(all.begin(), all.end(), 0);
  return RecordDirect(std::move(all), RecordDirect::Way::mirrored);
}

void PaneLight::reset(const rays::DirectLight& light, std::size_t groups) {
  const std::size_t count = light.mirrors() ? groups : 0;
  marked_.assign(count, 1);
  probes_.resize(count);
  records_ = records_by_panes(light, groups);
}

bool PaneLight::find(const rays::DirectLight& light, const Lit& lit, std::size_t& done, const Pace& pace,
                     const Control& control) {
  if (std::ranges::count(marked_, 1) == 0) return true;
  const std::size_t probes = lit.probes.size();
  if (done == 0) {
    for (std::size_t g = 0; g < marked_.size(); ++g) {
      if (!marked_[g]) continue;
      probes_[g].resize(probes);
      records_.forget(static_cast<int>(g));
    }
  }
  const bool all =
      pace.go_on(done, probes + lit.records.size(), least, [&](std::size_t begin, std::size_t end) {
        const std::size_t first = std::min(begin, probes), last = std::min(end, probes);
        parallel_for(
            last - first, 4,
            [&](std::size_t k) {
              for (std::size_t g = 0; g < marked_.size(); ++g) {
                if (!marked_[g]) continue;
                probes_[g][first + k] = project_arriving(
                    light.mirrored_arriving(static_cast<int>(g), lit.probes[first + k], probe_samples),
                    lit.degree);
              }
            },
            control);
        if (end > probes)
          records_.extend(light, lit.records.first(end - probes), lit.record_samples, control);
      });
  if (all) marked_.assign(marked_.size(), 0);
  return all;
}

void PaneLight::add_to(std::size_t group, const vec3& scale, std::vector<sh::RadianceSh>& probes) const {
  if (empty()) return;
  for (std::size_t i = 0; i < probes.size(); ++i) {
    for (std::size_t k = 0; k < probes[i].values.size(); ++k)
      probes[i].values[k] += scale * probes_[group][i].values[k];
  }
}

}  // namespace ssphh::transport
