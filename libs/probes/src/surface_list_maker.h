#pragma once
/// One list of a SurfaceLists: the points that light what lies in a box.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <ssphh/geometry/balls.h>
#include <ssphh/probes/surface_lists.h>

#include "still_surface.h"
#include "surface_samples.h"

namespace ssphh::probes {

/// Whether a sample sees a point.
enum class Seen : std::uint8_t { no, yes, through_glass };

/// Samples of a part of a box on surfaces that face one axis: one of each sheet of a few, a picture's front
/// and back and the wall behind it.
struct SampleLayers {
  static constexpr int most = 4;
  std::array<std::uint32_t, most> samples;
  int count = 0;
};

/// A cell of a grid, or several that may share a list.
struct ListedBox {
  vec3 corner;
  float size;       ///< of each side [m]
  float cell_size;  ///< of the grid [m]

  bool one_cell() const { return size == cell_size; }
};

/// What one thread needs while it makes a list.
struct ListWork {
  struct Candidate {
    std::uint32_t point;
    float order;                            ///< squared distance from the box's middle, over the spacing [m]
    std::vector<std::uint32_t> asked;       ///< samples that it may light
    std::vector<Seen> seen;                 ///< by those; empty: by all
    std::vector<std::uint32_t> outweighed;  ///< samples at which it does not count
  };
  std::vector<std::uint32_t> triangles;  ///< in the box, set by the caller; some may be named again
  std::vector<std::uint32_t> panes;      ///< those of glass
  SurfaceSamples samples;
  std::vector<SampleLayers> taken;  ///< in each part of the box, by axis
  std::vector<Candidate> candidates;
  float finest = 0;         ///< spacing of those [m]
  float cell_size = 0;      ///< ListedBox::cell_size
  std::vector<uvec4> list;  ///< what was made
};

class SurfaceListMaker {
 public:
  /// Keeps what it is given; the points must outlive it.
  SurfaceListMaker(std::span<const rays::SurfacePoint> points, std::vector<StillTriangle> triangles,
                   const SeesProbe& sees);

  const std::vector<StillTriangle>& triangles() const { return triangles_; }
  std::span<const float> spacings() const { return spacings_; }

  /// Makes the list of a cell, or of all cells of a box, where one serves them: none of its points stand
  /// dense for so large a cell, and all samples in the box see them. Then true; the list is empty where no
  /// point lights what is there. Called from several threads.
  bool make(const ListedBox& box, ListWork& work) const;

 private:
  struct CutParts {
    int cut;
    std::uint64_t seen;    ///< parts of the box, so cut, in which the point is looked up
    std::size_t lost = 0;  ///< samples that see it, in other parts
  };

  void take_samples(const ListedBox& box, ListWork& work) const;
  void find_near(const ListedBox& box, ListWork& work) const;
  bool ask_all(bool one_cell, ListWork& work) const;
  void ask(ListWork::Candidate& candidate, std::size_t number, ListWork& work) const;
  Seen sees(ListWork& work, std::size_t i, std::uint32_t p) const;
  bool sees_through(const std::vector<std::uint32_t>& panes, const vec3& from, const vec3& to) const;
  bool is_narrow(ListWork& work, std::size_t i, std::size_t side) const;
  CutParts seen_parts(const ListWork::Candidate& candidate, ListWork& work) const;
  CutParts cut_so(const ListWork::Candidate& candidate, int cut, ListWork& work) const;

  std::span<const rays::SurfacePoint> points_;
  std::vector<StillTriangle> triangles_;
  const SeesProbe& sees_;
  std::vector<float> spacings_;
  std::vector<int> cover_;
  std::vector<float> room_;  ///< headroom() up to that of see_along_surface [m]
  geometry::Balls reach_;
};

}  // namespace ssphh::probes
