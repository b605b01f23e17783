#include <algorithm>
#include <tuple>
#include <unordered_map>

#include <ssphh/core/error.h>
#include <ssphh/core/require.h>
#include <ssphh/geometry/delaunay.h>

namespace ssphh::geometry {
namespace {

constexpr std::int32_t infinite = -1, none = -1;

/// Two corners of the face opposite of vertex k.
constexpr int face_of[4][2] = {{1, 2}, {0, 3}, {0, 1}, {0, 2}};

struct Cell {
  std::array<std::int32_t, 4> vertex;
  std::array<std::int32_t, 4> neighbor;
  std::int32_t mark = -1;  ///< the point whose insertion looked at it last
  bool conflict = false;
  bool alive = true;

  int infinite_corner() const {
    for (int k = 0; k < 4; ++k)
      if (vertex[k] == infinite) return k;
    return -1;
  }
};

class Builder {
 public:
  explicit Builder(std::span<const LatticePoint> points) : points_(points) {}

  void start(std::array<std::int32_t, 4> corners) {
    if (orientation(at(corners[0]), at(corners[1]), at(corners[2]), at(corners[3])) < 0)
      std::swap(corners[2], corners[3]);
    cells_.push_back({corners, {1, 2, 3, 4}});
    // Beyond face k stands a cell whose vertex k is infinite; two corners swapped keep it positive.
    for (int k = 0; k < 4; ++k) {
      Cell cell{corners, {none, none, none, none}};
      cell.vertex[k] = infinite;
      const int i = face_of[k][0], j = face_of[k][1];
      std::swap(cell.vertex[i], cell.vertex[j]);
      cells_.push_back(cell);
    }
    for (std::int32_t c = 1; c <= 4; ++c) {
      Cell& cell = cells_[c];
      for (std::size_t k = 0; k < 4; ++k) {
        if (cell.vertex[k] == infinite) {
          cell.neighbor[k] = 0;
        } else {
          // the infinite cell that lacks this vertex
          const auto found = std::ranges::find(corners, cell.vertex[k]);
          cell.neighbor[k] = 1 + static_cast<std::int32_t>(found - corners.begin());
        }
      }
    }
  }

  void insert(std::int32_t p) {
    cavity_.clear();
    boundary_.clear();
    cavity_.push_back(find_conflict(p));
    touch(cavity_.front(), p);
    SSPHH_CHECK(cell(cavity_.front()).conflict);
    for (std::size_t i = 0; i < cavity_.size(); ++i) {
      for (std::size_t k = 0; k < 4; ++k) {
        const std::int32_t next = cell(cavity_[i]).neighbor[k];
        const bool seen = cell(next).mark == p;
        if (!seen) touch(next, p);
        if (!cell(next).conflict) {
          boundary_.emplace_back(cavity_[i], k);
        } else if (!seen) {
          cavity_.push_back(next);
        }
      }
    }
    fill(p);
  }

  std::vector<Tetrahedron> finite() const {
    std::vector<std::int32_t> index(cells_.size(), none);
    std::int32_t count = 0;
    for (std::size_t c = 0; c < cells_.size(); ++c)
      if (cells_[c].alive && cells_[c].infinite_corner() < 0) index[c] = count++;
    std::vector<Tetrahedron> result;
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      if (index[c] == none) continue;
      Tetrahedron& tet = result.emplace_back(Tetrahedron{cells_[c].vertex, {}});
      for (std::size_t k = 0; k < 4; ++k) tet.neighbor[k] = index[cells_[c].neighbor[k]];
    }
    return result;
  }

 private:
  const LatticePoint& at(std::int32_t v) const { return points_[v]; }
  Cell& cell(std::int32_t c) { return cells_[c]; }
  const Cell& cell(std::int32_t c) const { return cells_[c]; }

  /// Of the cell's corners with p in place of corner k.
  int side(const Cell& c, int k, std::int32_t p) const {
    std::array<std::int32_t, 4> v = c.vertex;
    v[k] = p;
    return orientation(at(v[0]), at(v[1]), at(v[2]), at(v[3]));
  }

  bool conflicts(const Cell& c, std::int32_t p) const {
    const int k = c.infinite_corner();
    if (k >= 0) {
      const int outside = side(c, k, p);
      if (outside != 0) return outside > 0;
      // In the hull face's plane: inside its circle where inside the sphere of the tetrahedron behind it.
      return conflicts(cell(c.neighbor[k]), p);
    }
    const auto& v = c.vertex;
    return in_sphere_perturbed({at(v[0]), at(v[1]), at(v[2]), at(v[3]), at(p)}, {v[0], v[1], v[2], v[3], p}) >
           0;
  }

  void touch(std::int32_t c, std::int32_t p) {
    cell(c).mark = p;
    cell(c).conflict = conflicts(cell(c), p);
  }

  /// Visibility walk; it ends in Delaunay triangulations (Edelsbrunner, An Acyclicity Theorem for Cell
  /// Complexes in d Dimensions, 1989).
  std::int32_t find_conflict(std::int32_t p) {
    std::int32_t now = newest_;
    if (const int k = cell(now).infinite_corner(); k >= 0) now = cell(now).neighbor[k];
    for (std::size_t step = 0; step <= cells_.size(); ++step) {
      const Cell& c = cell(now);
      if (c.infinite_corner() >= 0) return now;
      std::int32_t next = none;
      for (int k = 0; k < 4 && next == none; ++k)
        if (side(c, k, p) < 0) next = c.neighbor[k];
      if (next == none) return now;
      now = next;
    }
    SSPHH_CHECK(!"the walk ends");
    return none;
  }

  /// Cells from p to the cavity's boundary.
  void fill(std::int32_t p) {
    std::unordered_map<std::uint64_t, std::pair<std::int32_t, std::size_t>> open;
    for (const auto& [old, k] : boundary_) {
      Cell fresh{cell(old).vertex, {none, none, none, none}};
      fresh.vertex[k] = p;
      const std::int32_t outer = cell(old).neighbor[k];
      fresh.neighbor[k] = outer;
      const auto index = static_cast<std::int32_t>(cells_.size());
      for (std::int32_t& back : cell(outer).neighbor)
        if (back == old) back = index;
      for (std::size_t j = 0; j < 4; ++j) {
        if (j == k) continue;
        const std::uint64_t edge = edge_key(fresh, j, k);
        const auto [found, first] = open.try_emplace(edge, index, j);
        if (first) continue;
        fresh.neighbor[j] = found->second.first;
        cell(found->second.first).neighbor[found->second.second] = index;
        open.erase(found);
      }
      cells_.push_back(fresh);
      newest_ = index;
    }
    SSPHH_CHECK(open.empty());
    for (const std::int32_t c : cavity_) cell(c).alive = false;
    // Each point makes some twenty cells and ends as many: dead ones are dropped now and then.
    dead_ += cavity_.size();
    if (dead_ > 1024 && 2 * dead_ > cells_.size()) compact();
  }

  /// Of the edge that is left of a cell's corners without j and k.
  static std::uint64_t edge_key(const Cell& c, std::size_t j, std::size_t k) {
    std::uint64_t low = 0, high = 0;
    bool first = true;
    for (std::size_t i = 0; i < 4; ++i) {
      if (i == j || i == k) continue;
      (first ? low : high) = static_cast<std::uint64_t>(c.vertex[i] + 1);
      first = false;
    }
    if (low > high) std::swap(low, high);
    return low << 32 | high;
  }

  void compact() {
    std::vector<std::int32_t> index;
    index.reserve(cells_.size());
    std::size_t count = 0;
    for (const Cell& cell : cells_) index.push_back(cell.alive ? static_cast<std::int32_t>(count++) : none);
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      if (index[c] == none) continue;
      Cell moved = cells_[c];
      for (std::int32_t& n : moved.neighbor) n = index[n];
      cells_[index[c]] = moved;
    }
    newest_ = index[newest_];
    cells_.resize(count);
    dead_ = 0;
  }

  std::span<const LatticePoint> points_;
  std::vector<Cell> cells_;
  std::int32_t newest_ = 0;
  std::size_t dead_ = 0;
  std::vector<std::int32_t> cavity_;
  std::vector<std::pair<std::int32_t, std::size_t>> boundary_;
};

/// Exact signs and one cell around each point rest on it.
void require_lattice(std::span<const LatticePoint> points) {
  std::vector<LatticePoint> sorted(points.begin(), points.end());
  for (const LatticePoint& p : sorted) {
    for (int c = 0; c < 3; ++c)
      require(p[c] >= -lattice_range && p[c] <= lattice_range, "Delaunay tetrahedra",
              "a point lies outside the lattice");
  }
  std::ranges::sort(sorted, [](const LatticePoint& a, const LatticePoint& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  });
  require(std::ranges::adjacent_find(sorted) == sorted.end(), "Delaunay tetrahedra",
          "a point stands there twice");
}

}  // namespace

std::vector<std::int32_t> spanning_points(std::span<const LatticePoint> points) {
  std::vector<std::int32_t> found;
  for (std::size_t i = 0; i < points.size() && found.size() < 4; ++i) {
    const auto at = [&](std::size_t k) { return points[found[k]]; };
    bool wider = true;
    if (found.size() == 1) wider = points[i] != at(0);
    if (found.size() == 2) {
      const glm::i64vec3 u = glm::i64vec3(at(1)) - glm::i64vec3(at(0));
      const glm::i64vec3 v = glm::i64vec3(points[i]) - glm::i64vec3(at(0));
      wider = u.y * v.z != u.z * v.y || u.z * v.x != u.x * v.z || u.x * v.y != u.y * v.x;
    }
    if (found.size() == 3) wider = orientation(at(0), at(1), at(2), points[i]) != 0;
    if (wider) found.push_back(static_cast<std::int32_t>(i));
  }
  return found;
}

std::vector<Tetrahedron> delaunay(std::span<const LatticePoint> points) {
  const std::vector<std::int32_t> first = spanning_points(points);
  require(first.size() == 4, "Delaunay tetrahedra", "all points lie in one plane");
  require_lattice(points);
  Builder builder(points);
  builder.start({first[0], first[1], first[2], first[3]});
  for (std::int32_t p = 0; p < static_cast<std::int32_t>(points.size()); ++p)
    if (std::ranges::find(first, p) == first.end()) builder.insert(p);
  return builder.finite();
}

}  // namespace ssphh::geometry
