/// When the solver stops and how it gets there: every row and channel counts, and iterates are Chebyshev's.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include <ssphh/core/random.h>
#include <ssphh/transport/solve.h>

namespace ssphh::transport {
namespace {

/// Rows that each send light to themselves alone: E = ρ / (1 − ρ) E_direct in closed form.
struct Mirrors {
  std::vector<Link> links;
  LinkRows rows;
  std::vector<vec3> albedo;
  std::vector<Irradiance4> direct;

  explicit Mirrors(std::size_t count)
      : albedo(count, vec3(0.02f, 0.03f, 0.01f)), direct(count, Irradiance4(1, 2, 3, 0)) {
    for (std::size_t i = 0; i < count; ++i) links.push_back({static_cast<std::uint32_t>(i), 1});
    for (std::size_t i = 0; i < count; ++i)
      rows.rows.push_back({std::span<const Link>(links).subspan(i, i % 2), {}});
    for (std::size_t i = 0; i < count; i += 2)
      rows.rows[i].moving = std::span<const Link>(links).subspan(i, 1);
  }
  SolveReport solve(double bound, const SolveParams& params, std::vector<Irradiance4>& indirect) const {
    Solver solver;
    return solver.solve(rows, albedo, direct, bound, params, indirect);
  }
  vec3 exact(std::size_t i) const { return albedo[i] / (1.0f - albedo[i]) * vec3(direct[i]); }
};

TEST(SolveConvergence, WaitsForASlowRowWhereverItStandsAndWhicheverChannelIsSlow) {
  constexpr std::size_t count = 700;  // two full blocks of 256 rows and a part of one
  for (const std::size_t slow : {0u, 1u, 128u, 254u, 255u, 256u, 511u, 512u, 698u, 699u}) {
    for (int channel = 0; channel < 3; ++channel) {
      Mirrors mirrors(count);
      mirrors.albedo[slow][channel] = 0.9f;
      // Where another channel is the brighter one, the residual is relative to that one.
      mirrors.direct[slow] = Irradiance4(1, 1, 1, 0);
      std::vector<Irradiance4> indirect;
      const SolveReport report = mirrors.solve(1, {1e-4f, 300}, indirect);
      EXPECT_TRUE(report.converged);
      EXPECT_LE(report.residual, 1e-4f);
      for (const std::size_t i : {std::size_t{3}, slow, std::size_t{600}}) {
        for (int c = 0; c < 3; ++c) {
          const float exact = mirrors.exact(i)[c];
          // A last change of 1e-4 of E leaves the tail of a geometric series: 0.9 / (1 − 0.9) times that.
          EXPECT_NEAR(indirect[i][c], exact, 1e-4f * 10 * exact + 1e-6f)
              << "row " << i << " with row " << slow << " slow in channel " << channel;
        }
      }
    }
  }
}

TEST(SolveConvergence, PatchesOfARowDifferInDirectLightAndAlbedoAlone) {
  // E = w0 ρ0 (D0 + E) + w1 ρ1 (D1 + E), and row 1 sees one patch of row 0.
  const std::vector<Link> own = {{0, 0.5f}, {1, 0.25f}}, other = {{1, 0.5f}};
  LinkRows rows;
  rows.patches = 2;
  rows.rows = {{own, {}}, {other, {}}};
  const std::vector<vec3> albedo = {vec3(0.2f, 0.4f, 0.6f), vec3(0.8f, 0.5f, 0.1f), vec3(0), vec3(0)};
  const std::vector<Irradiance4> direct = {{1, 2, 3, 0}, {7, 5, 4, 0}, {9, 9, 9, 0}, {9, 9, 9, 0}};
  std::vector<Irradiance4> indirect;
  EXPECT_TRUE(Solver().solve(rows, albedo, direct, 0.6, {1e-6f, 300}, indirect).converged);
  ASSERT_EQ(indirect.size(), 2u);
  for (int c = 0; c < 3; ++c) {
    const float a = 0.5f * albedo[0][c], b = 0.25f * albedo[1][c];
    const float e = (a * direct[0][c] + b * direct[1][c]) / (1 - a - b);
    EXPECT_NEAR(indirect[0][c], e, 1e-5f * e);
    EXPECT_NEAR(indirect[1][c], 0.5f * albedo[1][c] * (direct[1][c] + e), 1e-4f);
  }
  const Contraction bounds = contraction(rows, albedo);
  const double most = 0.5 * 0.6 + 0.25 * 0.8;
  EXPECT_NEAR(bounds.upper, most, 1e-6);
}

/// Rows of `patches` that see patches of all others, of colours that differ from patch to patch.
struct Patchwork {
  std::vector<Link> links;
  LinkRows rows;
  std::vector<vec3> albedo;
  std::vector<Irradiance4> direct;

  explicit Patchwork(std::size_t patches, std::size_t count = 600, std::size_t per_row = 40) {
    rows.patches = patches;
    Pcg32 rng(patches);
    for (std::size_t p = 0; p < count * patches; ++p) {
      albedo.push_back(0.95f * rng.uniform3() * rng.uniform3());
      direct.emplace_back(p < 7 ? rng.uniform3() : vec3(0), 0);
    }
    for (std::size_t k = 0; k < count * per_row; ++k) {
      const auto patch =
          static_cast<std::uint32_t>(rng.uniform() * 0.99999f * static_cast<float>(albedo.size()));
      links.push_back({patch, 1 / static_cast<float>(per_row)});
    }
    for (std::size_t i = 0; i < count; ++i)
      rows.rows.push_back({std::span<const Link>(links).subspan(i * per_row, per_row), {}});
  }

  /// E by plain iteration between patches.
  std::vector<glm::dvec3> exact() const {
    std::vector<glm::dvec3> e(rows.rows.size(), glm::dvec3(0));
    for (int bounce = 0; bounce < 200; ++bounce) {
      std::vector<glm::dvec3> next(e.size(), glm::dvec3(0));
      for (std::size_t i = 0; i < e.size(); ++i) {
        for (const Link& link : rows.rows[i].fixed) {
          next[i] += double(link.weight) * glm::dvec3(albedo[link.patch]) *
                     (glm::dvec3(direct[link.patch]) + e[link.patch / rows.patches]);
        }
      }
      e.swap(next);
    }
    return e;
  }
};

TEST(SolveConvergence, EveryBounceHasThePatchesOwnAlbedo) {
  for (const std::size_t patches : {1u, 2u, 3u, 5u, 7u, 8u, 13u, 32u}) {
    const Patchwork work(patches);
    const std::vector<glm::dvec3> exact = work.exact();
    std::vector<Irradiance4> indirect;
    const SolveReport report =
        Solver().solve(work.rows, work.albedo, work.direct, 0.6, {1e-5f, 300}, indirect);
    EXPECT_TRUE(report.converged) << patches;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(double(indirect[i][c]), exact[i][c], 1e-4 * exact[i][c])
            << patches << " patches, row " << i;
    }
  }
}

TEST(SolveConvergence, DimRowsAreJudgedByAThousandthOfTheBrightest) {
  // Row 0 is done at once and gives the largest E of the last iteration; row 300 is slow and dim. Plain
  // iteration changes it by d ρⁿ in iteration n, to E = d ρ (1 − ρⁿ) / (1 − ρ).
  constexpr double rho = 0.95, dim = 1e-6, bright = 0.1 / 0.9, tolerance = 1e-3;
  Mirrors mirrors(301);
  std::fill(mirrors.direct.begin(), mirrors.direct.end(), Irradiance4(0));
  mirrors.albedo[0] = vec3(0.05f, 0.1f, 0.05f);
  mirrors.direct[0] = Irradiance4(1, 1, 1, 0);
  mirrors.albedo[300] = vec3(0.1f, 0.3f, float(rho));
  mirrors.direct[300] = Irradiance4(float(dim));
  int expected = 0;
  for (double power = rho, residual = 1; residual > tolerance; ++expected, power *= rho)
    residual = dim * power / (dim * rho * (1 - power) / (1 - rho) + 1e-3 * bright);
  std::vector<Irradiance4> indirect;
  EXPECT_EQ(mirrors.solve(1, {float(tolerance), 300}, indirect).iterations, expected);
}

TEST(SolveConvergence, IteratesAreChebyshevs) {
  // Where the matrix has the eigenvalue c = the bound, n steps leave 1 / T_n(1/c) of the error.
  constexpr double c = 0.9;
  Mirrors mirrors(10);
  std::fill(mirrors.albedo.begin(), mirrors.albedo.end(), vec3(float(c)));
  for (int n = 1; n <= 8; ++n) {
    std::vector<Irradiance4> indirect;
    const SolveReport report = mirrors.solve(c, {0, n}, indirect);
    EXPECT_EQ(report.iterations, n);
    EXPECT_FALSE(report.converged);
    const double left = 1 / std::cosh(n * std::acosh(1 / c));
    for (int k = 0; k < 3; ++k) {
      const double exact = double(mirrors.exact(4)[k]);
      EXPECT_NEAR(double(indirect[4][k]), exact * (1 - left), 1e-5 * exact) << "after " << n << " steps";
    }
  }
}

TEST(SolveConvergence, APocketThatKeepsItsLightDoesNotHoldUpTheRest) {
  // One row keeps all but 2e-5 of its light, as a white cupboard does: steps that cover it leave a third of
  // the error of all others after 300 of them.
  constexpr double pocket = 0.99998;
  Mirrors mirrors(600);
  std::fill(mirrors.albedo.begin(), mirrors.albedo.end(), vec3(0.8f, 0.5f, 0.1f));
  mirrors.albedo[300] = vec3(float(pocket));
  mirrors.direct[300] = Irradiance4(1e-9f, 1e-9f, 1e-9f, 0);
  std::vector<Irradiance4> covered, indirect;
  mirrors.solve(pocket, {1e-4f, 300}, covered);
  EXPECT_FALSE(mirrors.solve(pocket, {1e-4f, 300}, covered).converged);
  EXPECT_EQ(chebyshev_bound({0, pocket}), 0.98);
  EXPECT_EQ(chebyshev_bound({0, 0.7}), 0.7);
  const SolveReport report = mirrors.solve(chebyshev_bound({0, pocket}), {1e-4f, 300}, indirect);
  EXPECT_TRUE(report.converged);
  EXPECT_LT(report.iterations, 80);
  for (const std::size_t i : {0u, 299u, 301u, 599u}) {
    for (int c = 0; c < 3; ++c) {
      const float exact = mirrors.exact(i)[c];
      EXPECT_NEAR(indirect[i][c], exact, 1e-3f * exact);
    }
  }
}

TEST(SolveConvergence, LightThatGoesRoundInARingIsNoReasonToGiveUp) {
  // Each of three sees the next alone: eigenvalues ρ e^(±2πi/3), of which Chebyshev's steps make more and
  // more.
  const std::vector<Link> links{{1, 1}, {2, 1}, {0, 1}};
  LinkRows rows;
  for (std::size_t i = 0; i < 3; ++i) rows.rows.push_back({std::span(links).subspan(i, 1), {}});
  const std::vector<vec3> albedo(3, vec3(0.97f, 0.9f, 0.5f));
  std::vector<Irradiance4> direct(3, Irradiance4(0)), indirect;
  direct[0] = Irradiance4(1, 2, 3, 0);
  const SolveParams params{.max_iterations = 2000, .settle = true};
  for (const double bound : {0.97, 0.9}) {
    const SolveReport report = Solver().solve(rows, albedo, direct, bound, params, indirect);
    EXPECT_TRUE(report.converged) << report.residual;
    for (int c = 0; c < 3; ++c) {
      const float rho = albedo[0][c], all = direct[0][c] / (1 - rho * rho * rho);
      for (int i = 0; i < 3; ++i) {
        const float exact = all * std::pow(rho, static_cast<float>(3 - i));
        EXPECT_NEAR(indirect[i][c], exact, 3e-3f * exact) << i << " " << c;
      }
    }
    indirect.clear();
    Solver().solve(rows, albedo, direct, bound, {.max_iterations = 100, .settle = true}, indirect);
    EXPECT_GT(indirect[0].x + indirect[1].x + indirect[2].x, 0)
        << "the last of the iterations begins nothing";
    indirect.clear();
  }
}

TEST(SolveConvergence, LightThatIsToSettleHasItsLastBounces) {
  // A row that keeps all but ε of its light adds ε of it in a bounce: a residual says that it is done when
  // half of it is missing.
  constexpr std::size_t slow = 300;
  for (const float epsilon : {0.09f, 1e-2f, 1 - most_albedo}) {
    Mirrors mirrors(600);
    std::fill(mirrors.albedo.begin(), mirrors.albedo.end(), vec3(0.8f, 0.5f, 0.1f));
    mirrors.albedo[slow] = vec3(1 - epsilon);
    std::vector<Irradiance4> indirect;
    const SolveParams params{.max_iterations = 2000, .settle = true};
    const SolveReport report = mirrors.solve(chebyshev_bound({0, 1 - double(epsilon)}), params, indirect);
    EXPECT_TRUE(report.converged) << epsilon;
    EXPECT_LE(report.error, 1e-3f);
    for (const std::size_t i : {std::size_t{0}, slow, std::size_t{599}}) {
      for (int c = 0; c < 3; ++c) {
        const float exact = mirrors.exact(i)[c];
        EXPECT_NEAR(indirect[i][c], exact, 2e-3f * exact) << epsilon << " " << i;
      }
    }
  }
}

TEST(SolveConvergence, AWarmStartFollowsEachChannelsDirectLightUpToFourTimes) {
  Mirrors mirrors(5);
  Solver solver;
  std::vector<Irradiance4> indirect(5, Irradiance4(1, 2, 3, 0));
  // No iteration: what is left is the start.
  solver.solve(mirrors.rows, mirrors.albedo, mirrors.direct, 1, {1e-3f, 0}, indirect);
  EXPECT_EQ(indirect[3], Irradiance4(1, 2, 3, 0)) << "nothing is known of the light before";
  for (Irradiance4& e : mirrors.direct) e *= Irradiance4(0.25f, 3, 8, 0);
  solver.solve(mirrors.rows, mirrors.albedo, mirrors.direct, 1, {1e-3f, 0}, indirect);
  for (const Irradiance4& e : indirect) EXPECT_EQ(e, Irradiance4(0.25f, 6, 12, 0));
}

TEST(SolveConvergence, OneBounceIsTheMatrixTimesTheRadiosity) {
  // Rows of 0 to 11 links, split anywhere between fixed and moving.
  constexpr std::size_t count = 12;
  std::vector<Link> links;
  for (std::size_t i = 0; i < count * count; ++i)
    links.push_back({static_cast<std::uint32_t>(i * 7 % count), 0.01f * static_cast<float>(1 + i % 13)});
  LinkRows rows;
  std::vector<Irradiance4> radiosity;
  for (std::size_t i = 0; i < count; ++i) {
    const std::span<const Link> row(links.data() + i * count, i);
    rows.rows.push_back({row.first(i * 5 % (i + 1)), row.subspan(i * 5 % (i + 1))});
    const auto x = static_cast<float>(i);
    radiosity.emplace_back(1 + x, 2 + x * x, 30 - x, 0);
  }
  EXPECT_EQ(rows.link_count(), count * (count - 1) / 2);
  std::vector<Irradiance4> out(count);
  bounce_once(rows, radiosity, out);
  for (std::size_t i = 0; i < count; ++i) {
    glm::dvec3 expected(0);
    for (std::size_t k = 0; k < i; ++k) {
      const Link& link = links[i * count + k];
      expected += double(link.weight) * glm::dvec3(radiosity[link.patch]);
    }
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(double(out[i][c]), expected[c], 1e-5 * expected[c]) << i;
  }
}

}  // namespace
}  // namespace ssphh::transport
