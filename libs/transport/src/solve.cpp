#include <algorithm>
#include <cmath>
#include <numeric>

#include <ssphh/core/parallel.h>
#include <ssphh/core/require.h>
#include <ssphh/transport/solve.h>

namespace ssphh::transport {
namespace {

/// Rows per task: some 50 µs of work.
constexpr std::size_t rows_per_block = 256;
/// Where in so many iterations the residual has not shrunk to this share, steps begin anew for a smaller
/// bound.
constexpr int patience = 100;
constexpr float least_progress = 0.9f;
/// Below it steps are as good as plain.
constexpr double least_bound = 0.1;
/// Below it a residual within the tolerance leaves less than ten times as much.
constexpr double settling_bound = 0.9;

using float4 = float __attribute__((vector_size(16)));

float4 load(const Irradiance4& v) {
  float4 out;
  __builtin_memcpy(&out, &v, sizeof(out));
  return out;
}

/// sums += Σ_j weight_j · values_j. Four sums, so that the additions do not wait for each other.
void gather(std::span<const Link> links, const Irradiance4* values, float4 (&sums)[4]) {
  std::size_t i = 0;
  for (; i + 4 <= links.size(); i += 4) {
    for (std::size_t k = 0; k < 4; ++k) {
      const Link& link = links[i + k];
      sums[k] += link.weight * load(values[link.patch]);
    }
  }
  for (; i < links.size(); ++i) sums[0] += links[i].weight * load(values[links[i].patch]);
}

Irradiance4 gather(const LinkRows::Row& row, const Irradiance4* values) {
  float4 sums[4] = {};
  gather(row.fixed, values, sums);
  gather(row.moving, values, sums);
  const float4 sum = (sums[0] + sums[1]) + (sums[2] + sums[3]);
  return {sum[0], sum[1], sum[2], 0};
}

}  // namespace

std::size_t LinkRows::link_count() const {
  std::size_t count = 0;
  for (const Row& row : rows) count += row.fixed.size() + row.moving.size();
  return count;
}

void bounce_once(const LinkRows& links, std::span<const Irradiance4> radiosity, std::span<Irradiance4> out) {
  require(radiosity.size() == links.patch_count() && out.size() == links.rows.size(), "bounce",
          "sizes differ from the number of rows");
  parallel_for(links.rows.size(), rows_per_block,
               [&](std::size_t i) { out[i] = gather(links.rows[i], radiosity.data()); });
}

Contraction contraction(const LinkRows& links, std::span<const vec3> albedo, int steps) {
  require(albedo.size() == links.patch_count(), "surfels", "there is not the albedo of each patch");
  const auto apply = [&](std::span<const double> x, std::span<double> y) {
    for (std::size_t i = 0; i < y.size(); ++i) {
      y[i] = 0;
      for (const auto& part : {links.rows[i].fixed, links.rows[i].moving}) {
        for (const Link& link : part)
          y[i] +=
              double(link.weight) * double(max_component(albedo[link.patch])) * x[link.patch / links.patches];
      }
    }
  };
  return ssphh::contraction(links.rows.size(), apply, steps);
}

namespace {

/// By what a step for the bound shrinks light that a bounce shrinks to a share `slowest`.
double rate_of(double bound, double slowest) {
  if (bound <= 0) return 0;
  if (bound >= 1) return double(most_albedo);
  return std::exp(std::acosh(std::max(slowest / bound, 1.0)) - std::acosh(1 / bound));
}

}  // namespace

double chebyshev_bound(const Contraction& contraction) {
  return std::min(contraction.upper, most_chebyshev_bound);
}

SolveReport Solver::solve(const LinkRows& links, std::span<const vec3> albedo,
                          std::span<const Irradiance4> direct, double contraction_bound,
                          const SolveParams& params, std::vector<Irradiance4>& indirect) {
  begin(links, albedo, direct, contraction_bound, params, indirect);
  while (!iterate()) {
  }
  return report_;
}

void Solver::begin(const LinkRows& links, std::span<const vec3> albedo, std::span<const Irradiance4> direct,
                   double contraction_bound, const SolveParams& params, std::vector<Irradiance4>& indirect) {
  const std::size_t count = links.rows.size(), patches = links.patch_count();
  require(albedo.size() == patches && direct.size() == patches, "solver",
          "sizes differ from the number of rows");
  require(params.tolerance >= 0, "solver", "the tolerance must be a number from 0 up");
  require(params.max_iterations >= 0, "solver", "fewer than 0 iterations");
  problem_ = {&links, albedo, direct, contraction_bound, params, &indirect};
  problem_.slowest = contraction_bound < most_chebyshev_bound ? contraction_bound : double(most_albedo);
  problem_.rate = rate_of(contraction_bound, problem_.slowest);
  report_ = {};
  report_.converged = count == 0;
  const std::size_t blocks = (count + rows_per_block - 1) / rows_per_block;
  indirect.resize(count, Irradiance4(0));
  previous_.resize(count);
  radiosity_.resize(patches);
  next_radiosity_.resize(patches);
  block_residual_.assign(blocks, 0);
  block_largest_.assign(blocks, 0);
  block_change_.assign(blocks, 0);
  block_sum_.assign(blocks, 0);

  // Start from what `indirect` holds: the right answer already where all that changed is the lamps' power.
  for (const Irradiance4& e : direct) problem_.sum += glm::dvec3(e);
  Irradiance4 start_scale(1);
  for (int c = 0; last_sum_ && c < 3; ++c) {
    if ((*last_sum_)[c] > 0)
      start_scale[c] = static_cast<float>(std::min(problem_.sum[c] / (*last_sum_)[c], 4.0));
  }
  parallel_for(count, rows_per_block, [&](std::size_t begin, std::size_t end) {
    float largest = 0;
    for (std::size_t i = begin; i < end; ++i) {
      indirect[i] *= start_scale;
      previous_[i] = indirect[i];
      set_radiosity(i, indirect[i], radiosity_);
      largest = std::max(largest, max_component(vec3(indirect[i])));
    }
    block_largest_[begin / rows_per_block] = largest;
  });
}

void Solver::set_radiosity(std::size_t row, const Irradiance4& indirect,
                           std::vector<Irradiance4>& radiosity) const {
  const std::size_t patches = problem_.links->patches;
  for (std::size_t p = row * patches; p < (row + 1) * patches; ++p)
    radiosity[p] = vec4(problem_.albedo[p], 0) * (problem_.direct[p] + indirect);
}

bool Solver::iterate() {
  if (!finished()) bounce();
  if (!finished()) return false;
  last_sum_ = problem_.sum;
  return true;
}

/// One bounce of every surfel, and from it Chebyshev's step; all that the next one reads is written at once.
void Solver::bounce() {
  Problem& p = problem_;
  std::vector<Irradiance4>& indirect = *p.indirect;
  const auto largest_of = [](const std::vector<float>& values) {
    return values.empty() ? 0 : *std::ranges::max_element(values);
  };
  const auto w = static_cast<float>(p.omega);
  const float floor = 1e-3f * largest_of(block_largest_);
  const std::vector<LinkRows::Row>& rows = p.links->rows;
  parallel_for(rows.size(), rows_per_block, [&](std::size_t begin, std::size_t end) {
    float residual = 0, largest = 0, change = 0, sum = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const Irradiance4 bounced = gather(rows[i], radiosity_.data());
      const float scale = max_component(vec3(bounced));
      const float difference = max_component(glm::abs(vec3(bounced - indirect[i])));
      residual = std::max(residual, difference / std::max(scale + floor, 1e-30f));
      largest = std::max(largest, scale);
      // Chebyshev's steps may overshoot by a hair where next to nothing arrives.
      const Irradiance4 next = glm::max(w * (bounced - previous_[i]) + previous_[i], Irradiance4(0));
      change += max_component(glm::abs(vec3(next - indirect[i])));
      sum += max_component(vec3(next));
      previous_[i] = indirect[i];
      indirect[i] = next;
      set_radiosity(i, next, next_radiosity_);
    }
    block_residual_[begin / rows_per_block] = residual;
    block_largest_[begin / rows_per_block] = largest;
    block_change_[begin / rows_per_block] = double(change);
    block_sum_[begin / rows_per_block] = double(sum);
  });
  radiosity_.swap(next_radiosity_);
  const double c2 = p.bound * p.bound;
  if (p.bound < 1) p.omega = p.steps == 0 ? 1 / (1 - c2 / 2) : 1 / (1 - c2 * p.omega / 4);
  ++report_.iterations;
  report_.residual = largest_of(block_residual_);
  const double sum = std::accumulate(block_sum_.begin(), block_sum_.end(), 0.0),
               change = std::accumulate(block_change_.begin(), block_change_.end(), 0.0);
  report_.error = sum > 0 ? static_cast<float>(change / sum * p.rate / (1 - p.rate)) : 0;
  const bool settles = p.params.settle && p.slowest >= settling_bound;
  report_.converged =
      report_.residual <= p.params.tolerance && (!settles || report_.error <= p.params.tolerance);
  if (++p.steps % patience != 0 || !(p.bound < 1)) return;
  const bool in_vain = report_.residual > least_progress * p.residual_before;
  p.residual_before = report_.residual;
  if (in_vain && !finished()) begin_anew();
}

/// Links are not symmetric: where light goes round in a ring, eigenvalues are complex. Steps for a bound c
/// cover the ellipses of foci ±c that leave 1 outside (Manteuffel 1977): up to 0.2 off the axis for 0.98,
/// 0.55 for 0.83; what is beyond grows. Plain steps from darkness only ever add the next bounce.
void Solver::begin_anew() {
  Problem& p = problem_;
  p.bound = p.bound * p.bound * p.bound;
  if (p.bound < least_bound) p.bound = 1;
  p.rate = rate_of(p.bound, p.slowest);
  p.omega = 1;
  p.steps = 0;
  p.residual_before = 1;
  std::ranges::fill(*p.indirect, Irradiance4(0));
  std::ranges::fill(previous_, Irradiance4(0));
  for (std::size_t i = 0; i < previous_.size(); ++i) set_radiosity(i, previous_[i], radiosity_);
  std::ranges::fill(block_largest_, 0.0f);
}

}  // namespace ssphh::transport
