// The text resource for Godot, walked as Godot walks it.

#include <algorithm>
#include <bit>

#include <gmock/gmock.h>

#include <ssphh/core/parse_number.h>
#include <ssphh/core/random.h>

#include "expect_near.h"
#include "field_sets.h"

namespace ssphh::probe_export {
namespace {

/// The numbers of `"key": Type(…)`.
template <class Number>
std::vector<Number> numbers(std::string_view text, const std::string& key) {
  const std::size_t begin = text.find('(', text.find("\"" + key + "\":")) + 1;
  std::vector<Number> found;
  std::string word;
  for (const char c : text.substr(begin, text.find(')', begin) + 1 - begin)) {
    if (c != ',' && c != ')') {
      if (c != ' ') word += c;
      continue;
    }
    const std::optional<Number> number = parse_number<Number>(word);
    EXPECT_TRUE(number) << key << ": " << word;
    found.push_back(number.value_or(0));
    word.clear();
  }
  return found;
}

class GodotReader {
 public:
  explicit GodotReader(std::string_view text)
      : points_(numbers<float>(text, "points")),
        sh_(numbers<float>(text, "sh")),
        bounds_(numbers<float>(text, "bounds")),
        tetrahedra_(numbers<std::int32_t>(text, "tetrahedra")),
        bsp_(numbers<std::int32_t>(text, "bsp")) {}

  std::size_t point_count() const { return points_.size() / 3; }
  std::size_t color_count() const { return sh_.size() / 4; }
  std::int32_t tetrahedron_count() const { return static_cast<std::int32_t>(tetrahedra_.size() / 4); }
  vec3 low() const { return {bounds_[0], bounds_[1], bounds_[2]}; }
  vec3 size() const { return {bounds_[3], bounds_[4], bounds_[5]}; }

  /// −1: an empty leaf.
  std::int32_t walk(const vec3& p) const {
    std::int32_t node = 0;
    while (node >= 0) {
      const std::int32_t* at = bsp_.data() + 6 * node;
      const vec3 n(std::bit_cast<float>(at[0]), std::bit_cast<float>(at[1]), std::bit_cast<float>(at[2]));
      const std::int32_t next = glm::dot(n, p) > std::bit_cast<float>(at[3]) ? at[4] : at[5];
      EXPECT_TRUE(next < 0 || next > node);
      node = next;
    }
    return node == INT32_MIN ? -1 : -node - 1;
  }
  vec4 barycentric(std::int32_t t, const vec3& p) const {
    const vec3 a = corner(t, 0), b = corner(t, 1), c = corner(t, 2), d = corner(t, 3);
    const auto volume = [](const vec3& o, const vec3& u, const vec3& v, const vec3& w) {
      return glm::dot(glm::dvec3(u - o), glm::cross(glm::dvec3(v - o), glm::dvec3(w - o)));
    };
    const double all = volume(a, b, c, d);
    return {volume(p, b, c, d) / all, volume(a, p, c, d) / all, volume(a, b, p, d) / all,
            volume(a, b, c, p) / all};
  }
  float least(std::int32_t t, const vec3& p) const {
    const vec4 w = barycentric(t, p);
    return std::min({w.x, w.y, w.z, w.w});
  }
  /// What the captured light gives a normal, to be multiplied with the albedo.
  vec3 diffuse(const vec3& p, const vec3& n) const {
    const std::int32_t t = walk(p);
    vec3 sh[9] = {};
    if (t < 0) return vec3(0);
    const vec4 w = glm::clamp(barycentric(t, p), 0.0f, 1.0f);
    for (int k = 0; k < 4; ++k) {
      const auto index = static_cast<std::size_t>(tetrahedra_[4 * t + k]);
      for (std::size_t j = 0; j < 9; ++j) {
        const float* color = sh_.data() + 4 * (9 * index + j);
        sh[j] += w[k] * vec3(color[0], color[1], color[2]);
      }
    }
    const float c[5] = {0.886227f, 1.023327f, 0.858086f, 0.247708f, 0.429043f};
    return c[0] * sh[0] + c[1] * (sh[1] * n.y + sh[2] * n.z + sh[3] * n.x) +
           c[2] * (sh[4] * (n.x * n.y) + sh[5] * (n.y * n.z) + sh[7] * (n.x * n.z)) +
           c[3] * sh[6] * (3 * n.z * n.z - 1) + c[4] * sh[8] * (n.x * n.x - n.y * n.y);
  }

 private:
  vec3 corner(std::int32_t t, int k) const {
    const auto i = static_cast<std::size_t>(3 * tetrahedra_[4 * t + k]);
    return {points_[i], points_[i + 1], points_[i + 2]};
  }

  std::vector<float> points_, sh_, bounds_;
  std::vector<std::int32_t> tetrahedra_, bsp_;
};

GodotReader exported(const probes::ProbeSet& set) {
  const Exported file = find_target("godot").write({set, open_space}, "probes", {});
  return GodotReader(text_of(file.files.at(0)));
}

/// Off the lattice, so that no two tetrahedra are alike.
probes::ProbeSet scattered(bool linear) {
  probes::ProbeSet set = field_set(linear);
  Pcg32 random(5);
  for (probes::Probe& probe : set.probes) {
    probe.position += 0.3f * random.uniform3() - 0.15f;
    for (int k = 0; k < 9; ++k) probe.groups[0].reflected[k] = 0.5f * field(k, probe.position, linear);
  }
  probes::merge_groups(set);
  return set;
}

TEST(Godot, WalkFindsTheTetrahedronThatHoldsAPoint) {
  for (const bool lattice : {true, false}) {
    const GodotReader reader = exported(lattice ? field_set(false) : scattered(false));
    EXPECT_EQ(reader.point_count(), 125u + 8u);
    EXPECT_EQ(reader.color_count(), 9 * reader.point_count());
    Pcg32 random(11);
    for (int i = 0; i < 1000; ++i) {
      const vec3 p = reader.low() + reader.size() * random.uniform3();
      const std::int32_t found = reader.walk(p);
      ASSERT_GE(found, 0);
      std::int32_t best = 0;
      for (std::int32_t t = 1; t < reader.tetrahedron_count(); ++t)
        if (reader.least(t, p) > reader.least(best, p)) best = t;
      // On a face shared by two either will do; the planes are rounded to floats.
      EXPECT_TRUE(found == best || reader.least(found, p) > -1e-4f);
    }
  }
}

TEST(Godot, BoundsReachBeyondProbesAndSurfacesOnEverySide) {
  const probes::ProbeSet set = scattered(false);
  scene::Bounds probes;
  for (const probes::Probe& probe : set.probes) probes.add(probe.position);
  const GodotReader reader = exported(set);
  const vec3 low = probes.min - reader.low(), high = reader.low() + reader.size() - probes.max;
  for (int c = 0; c < 3; ++c) {
    EXPECT_GT(low[c], 0.01f) << c;
    EXPECT_NEAR(high[c], low[c], 1e-4f) << c << ": as far on both sides";
  }
}

TEST(Godot, ReadsIrradianceOverPi) {
  for (const bool linear : {false, true}) {
    const GodotReader reader = exported(scattered(linear));
    Pcg32 random(13);
    for (int i = 0; i < 300; ++i) {
      const vec3 p = 1.2f * random.uniform3() - 0.6f;  // within the probes' hull
      const vec3 n = glm::normalize(2.0f * random.uniform3() - 1.0f);
      // Six digits of the engine's constants, and of lattice places.
      test::expect_near(reader.diffuse(p, n), field_irradiance(p, n, linear) / pi, 1e-3f);
    }
  }
}

}  // namespace
}  // namespace ssphh::probe_export
