// Spherical harmonics: evaluation and projection, beside what the core's multiply-add units could do at most.

#include <chrono>

#include <benchmark/benchmark.h>

#include <ssphh/core/random.h>
#include <ssphh/core/sphere.h>
#include <ssphh/sh/evaluate.h>
#include <ssphh/sh/operators.h>
#include <ssphh/sh/project.h>
#include <ssphh/sh/reconstruct.h>
#include <ssphh/sh/rotate.h>
#include <ssphh/sh/triple_product.h>

#include "peak_fma.h"

namespace ssphh::sh {
namespace {

std::vector<vec3> directions(int count) {
  std::vector<vec3> result;
  for (int i = 0; i < count; ++i) result.push_back(spherical_fibonacci(i, count));
  return result;
}

RadianceSh random_sh(int degree) {
  Pcg32 random(1);
  RadianceSh sh(degree);
  for (vec3& value : sh.values) value = random.uniform3();
  return sh;
}

void eval_single(benchmark::State& state) {
  const auto points = directions(1024);
  std::array<float, max_coefficient_count> basis{};
  for (auto _ : state) {
    for (const vec3& d : points) {
      eval_basis(static_cast<int>(state.range(0)), d, basis);
      benchmark::DoNotOptimize(basis);
    }
  }
  state.counters["directions/s"] =
      benchmark::Counter(static_cast<double>(points.size()), benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(eval_single)->Arg(2)->Arg(9)->Arg(10);

void eval_batch(benchmark::State& state) {
  const auto points = directions(1024);
  const int degree = static_cast<int>(state.range(0));
  std::vector<float> x, y, z, out(points.size() * static_cast<std::size_t>(coefficient_count(degree)));
  for (const vec3& d : points) x.push_back(d.x), y.push_back(d.y), z.push_back(d.z);
  for (auto _ : state) {
    eval_basis(degree, x, y, z, out);
    benchmark::DoNotOptimize(out.data());
    benchmark::ClobberMemory();
  }
  state.counters["directions/s"] =
      benchmark::Counter(static_cast<double>(points.size()), benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(eval_batch)->Arg(2)->Arg(9)->Arg(10);

// Counters: nominal = texels × coefficients × 3, what the definition asks for; executed = what the
// accumulation does after the cube's mirror symmetry (evaluating the basis and combining the mirror images
// come on top). Shares are of the peak above and may exceed 1 for nominal.
void count_fma(benchmark::State& state, double nominal, double executed) {
  using benchmark::Counter;
  state.counters["nominal_fma/s"] = Counter(nominal, Counter::kIsIterationInvariantRate);
  state.counters["executed_fma/s"] = Counter(executed, Counter::kIsIterationInvariantRate);
  state.counters["nominal_share"] =
      Counter(nominal / benchmarks::peak_fma_rate(), Counter::kIsIterationInvariantRate);
  state.counters["executed_share"] =
      Counter(executed / benchmarks::peak_fma_rate(), Counter::kIsIterationInvariantRate);
}

void project_cube_map(benchmark::State& state) {
  const int size = static_cast<int>(state.range(0)), degree = static_cast<int>(state.range(1));
  Pcg32 random(1);
  std::vector<float> texels(static_cast<std::size_t>(size) * static_cast<std::size_t>(size) * 3);
  for (float& value : texels) value = random.uniform();
  const std::vector<float> other(texels.rbegin(), texels.rend());
  std::vector<std::vector<float>> storage;
  for (int face = 0; face < 6; ++face) storage.push_back(face % 2 ? texels : other);
  const CubeFaces faces = {storage[0], storage[1], storage[2], storage[3], storage[4], storage[5]};
  const CubeProjector projector(degree, size);
  for (auto _ : state) {
    RadianceSh sh = projector.project(faces);
    benchmark::DoNotOptimize(sh.values.data());
  }
  count_fma(state, 6.0 * size * size * coefficient_count(degree) * 3,
            static_cast<double>(projector.executed_fma_count()));
}
BENCHMARK(project_cube_map)->Args({64, 10})->Args({64, 9})->Args({64, 2})->Args({256, 10});

// The same sum over arbitrary directions, without symmetry.
void project_samples(benchmark::State& state) {
  const int degree = 10;
  const auto points = directions(6 * 64 * 64);
  const std::vector<float> weights(points.size(), 4 * pi / static_cast<float>(points.size()));
  const std::vector<vec3> radiance(points.size(), vec3(1, 2, 3));
  for (auto _ : state) {
    RadianceSh sh = project(degree, points, weights, radiance);
    benchmark::DoNotOptimize(sh.values.data());
  }
  const double fma = static_cast<double>(points.size()) * coefficient_count(degree) * 3;
  count_fma(state, fma, fma);
}
BENCHMARK(project_samples);

// What a new size costs once: exact texel solid angles.
void make_cube_projector(benchmark::State& state) {
  for (auto _ : state) {
    CubeProjector projector(10, 64);
    benchmark::DoNotOptimize(projector);
  }
}
BENCHMARK(make_cube_projector);

void reconstruct(benchmark::State& state) {
  const RadianceSh sh = random_sh(10);
  const auto points = directions(1024);
  std::vector<vec3> out(points.size());
  for (auto _ : state) {
    eval(sh, points, out);
    benchmark::DoNotOptimize(out.data());
  }
  state.counters["directions/s"] =
      benchmark::Counter(static_cast<double>(points.size()), benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(reconstruct);

void coefficient_product(benchmark::State& state) {
  const RadianceSh a = random_sh(10), b = random_sh(10);
  RadianceSh sum(10);
  for (auto _ : state) {
    add_coefficient_product(sum, a, b);
    benchmark::DoNotOptimize(sum.values.data());
  }
}
BENCHMARK(coefficient_product);

void rotation_of_all_bands(benchmark::State& state) {
  const RadianceSh sh = random_sh(10);
  const quat q = glm::angleAxis(1.0f, glm::normalize(vec3(1, 2, 3)));
  for (auto _ : state) {
    RadianceSh turned = rotate(sh, q);
    benchmark::DoNotOptimize(turned.values.data());
  }
}
BENCHMARK(rotation_of_all_bands);

void product_of_functions(benchmark::State& state) {
  const int degree = static_cast<int>(state.range(0));
  const TripleProductTensor tensor(degree, degree, degree);
  const RadianceSh a = random_sh(degree), b = random_sh(degree);
  for (auto _ : state) {
    RadianceSh product = tensor.product(a, b);
    benchmark::DoNotOptimize(product.values.data());
  }
  state.counters["entries"] = static_cast<double>(tensor.entries().size());
}
BENCHMARK(product_of_functions)->Arg(2)->Arg(5)->Arg(10);

}  // namespace
}  // namespace ssphh::sh

BENCHMARK_MAIN();
