#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <ssphh/sh/coefficients.h>

#include "pace.h"
#include "record_direct.h"

namespace ssphh::transport {

/// Light of emitters that panes mirror to probes and records, of each light group, unscaled. Empty where
/// there are no panes.
class PaneLight {
 public:
  /// What it lights: probes of a degree, and records with so many samples of each emitter.
  struct Lit {
    std::span<const vec3> probes;
    int degree = 0;
    std::span<const rays::SurfacePoint> records;
    int record_samples = 1;
  };

  /// All of it is to be found anew.
  void reset(const rays::DirectLight& light, std::size_t groups);
  bool empty() const { return probes_.empty(); }
  /// A group's is to be found anew.
  void mark(std::size_t group) {
    if (!empty()) marked_[group] = 1;
  }
  void mark_all() { marked_.assign(marked_.size(), 1); }

  /// Finds what is marked, or as much of it as there is time for, from `done` on; true: that is all. Throws
  /// Cancelled; all of it is still marked then.
  bool find(const rays::DirectLight& light, const Lit& lit, std::size_t& done, const Pace& pace,
            const Control& control);

  /// Adds a group's to the probes' light.
  void add_to(std::size_t group, const vec3& scale, std::vector<sh::RadianceSh>& probes) const;
  /// Adds all groups' to the records' light.
  void add_to(std::vector<probes::RecordLight>& records, std::span<const vec3> scales) const {
    records_.add_to(records, scales);
  }

 private:
  std::vector<std::uint8_t> marked_;                 ///< of each group
  std::vector<std::vector<sh::RadianceSh>> probes_;  ///< [group][probe]
  RecordDirect records_;
};

/// That of all groups at records, where panes mirror light; else of none.
RecordDirect records_by_panes(const rays::DirectLight& light, std::size_t groups);

}  // namespace ssphh::transport
