#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/counted.h>
#include <ssphh/core/error.h>
#include <ssphh/core/memory.h>
#include <ssphh/core/require.h>
#include <ssphh/lightmap/layout.h>

namespace ssphh::lightmap {
namespace {

/// What lighting takes: colours, places, normals, marks.
constexpr std::uint64_t bytes_per_texel = 128;
constexpr std::array default_sizes = {1024, 2048, 4096};
constexpr float largest_chart = 1e9f;  ///< [m]

/// Texels between the first and the last centre. A chart that is larger than an atlas can be has one too
/// many.
int steps(float metres, float density) {
  const float texels = std::min(metres * density, 2.0f * most_size);
  return std::max(1, static_cast<int>(std::lround(texels)));
}

std::optional<Layout> try_density(std::span<const Chart> charts, int size, float density, int least) {
  std::vector<glm::ivec2> sizes;
  double area = 0;
  for (const Chart& chart : charts) {
    float its = std::ldexp(density, -chart.halvings);
    if (chart.size.x > 0) its = std::max(its, static_cast<float>(least) / chart.size.x);
    const glm::ivec2 count(steps(chart.size.x, its) + 1, steps(chart.size.y, its) + 1);
    sizes.push_back(count + 2 * gutter);
    area += static_cast<double>(sizes.back().x) * static_cast<double>(sizes.back().y);
  }
  if (area > static_cast<double>(size) * static_cast<double>(size)) return std::nullopt;
  const std::optional<Packing> packing = pack(sizes, size, size);
  if (!packing) return std::nullopt;
  Layout out{size, std::min(size, (packing->height + 3) / 4 * 4), density, {}};
  for (std::size_t i = 0; i < charts.size(); ++i) {
    const glm::ivec2 count = sizes[i] - 2 * gutter;
    out.places.push_back({packing->at[i] + gutter, count, vec2(count - 1) / charts[i].size});
  }
  return out;
}

/// The densest that fits, within a hundredth; none where not even four texels a chart do.
std::optional<Layout> densest(std::span<const Chart> charts, int size, int least) {
  double area = 0;
  for (const Chart& chart : charts)
    area += std::ldexp(static_cast<double>(chart.size.x) * static_cast<double>(chart.size.y),
                       -2 * chart.halvings);
  float high = 2 * static_cast<float>(size / std::sqrt(area)), low = 1e-5f * high;
  std::optional<Layout> best = try_density(charts, size, low, least);
  if (!best) return least > 1 ? densest(charts, size, 1) : std::nullopt;
  while (high > 1.01f * low) {
    const float middle = std::sqrt(low * high);
    if (std::optional<Layout> found = try_density(charts, size, middle, least)) {
      best = std::move(found), low = middle;
    } else {
      high = middle;
    }
  }
  return best;
}

[[noreturn]] void refuse_size(std::span<const Chart> charts, int size) {
  throw Error(
      "lightmap",
      fmt::format("{} do not fit into {} × {} texels, each with a gutter of {}",
                  counted(charts.size(), "chart"), size, size, gutter),
      size < most_size ? fmt::format("try --size {}", std::min(most_size, 2 * size)) : "split the scene");
}

Layout with_density(std::span<const Chart> charts, std::optional<int> size, float density, int least) {
  constexpr int smallest = 64;
  for (const int few : {least, 1})
    for (int s = size.value_or(smallest); s <= size.value_or(most_size); s *= 2)
      if (std::optional<Layout> found = try_density(charts, s, density, few)) return *found;
  const int largest = size.value_or(most_size);
  const std::optional<Layout> fits = densest(charts, largest, least);
  if (!fits) refuse_size(charts, largest);
  throw Error("lightmap",
              fmt::format("{:g} texels per metre do not fit into {} × {} texels", density, largest, largest),
              fmt::format("--texels-per-metre {:.3g} would{}", 0.99f * fits->density,
                          largest < most_size ? "; or give a larger --size" : ""));
}

Layout without_density(std::span<const Chart> charts, std::optional<int> size, int least) {
  std::optional<Layout> found;
  if (size) {
    found = densest(charts, *size, least);
    if (!found) refuse_size(charts, *size);
    return *found;
  }
  for (const int s : default_sizes) {
    found = densest(charts, s, least);
    if (found && found->density >= enough_density) return *found;
  }
  if (!found) refuse_size(charts, default_sizes.back());
  return *found;
}

}  // namespace

bool is_dense_enough(std::span<const Chart> charts, const LayoutParams& params) {
  if (params.density)
    return try_density(charts, params.size.value_or(most_size), *params.density, 1).has_value();
  const std::optional<Layout> found =
      densest(charts, params.size.value_or(default_sizes.front()), params.least);
  return found && found->density >= enough_density;
}

Layout lay_out(std::span<const Chart> charts, const LayoutParams& params) {
  if (charts.empty())
    throw Error("lightmap", "the scene has no still surface that light could be kept for",
                "what moves, unlit materials and clear glass have none");
  for (const Chart& chart : charts)
    require(chart.size.x >= 0 && chart.size.x <= largest_chart && chart.size.y >= 0 &&
                chart.size.y <= largest_chart,
            "lightmap", "the size of a chart must be metres of 0 to 1e9");
  require(params.least >= 1, "lightmap", "a chart has at least 1 texel");
  for (const Chart& chart : charts)
    require(chart.halvings >= 0 && chart.halvings < 32, "lightmap",
            "a chart's texels must be 1 to 2^31 times as wide");
  if (params.size && (*params.size < 16 || *params.size > most_size))
    throw Error("lightmap", fmt::format("a size of {} texels", *params.size),
                fmt::format("give 16 to {}", most_size));
  if (params.density && !(*params.density > 0 && std::isfinite(*params.density)))
    throw Error("lightmap", fmt::format("{:g} texels per metre", *params.density), "give more than 0");
  Layout out = params.density ? with_density(charts, params.size, *params.density, params.least)
                              : without_density(charts, params.size, params.least);
  const std::uint64_t bytes =
      static_cast<std::uint64_t>(out.width) * static_cast<std::uint64_t>(out.height) * bytes_per_texel;
  if (bytes > memory_of_machine())
    throw Error("lightmap",
                fmt::format("{} × {} texels take {} MB, more than this machine has", out.width, out.height,
                            bytes >> 20),
                "give a smaller --size");
  return out;
}

}  // namespace ssphh::lightmap
