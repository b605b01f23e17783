#include "lobe_table.h"

#include <algorithm>
#include <cmath>

#include <ssphh/sh/evaluate.h>

namespace ssphh::sketch {
namespace {

int degree_of(const Lobe& lobe) {
  for (int degree = 0; degree <= sh::max_degree; ++degree)
    if (static_cast<std::size_t>(sh::coefficient_count(degree)) == lobe.values.size()) return degree;
  throw Error("lobe", "its values are not those of a degree 0..10");
}

}  // namespace

LobeGrid::LobeGrid(int degree) : degree_(degree), nodes_(8 * (degree + 1) + 9) {
  std::vector<float> x, y, z;
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2;
    for (int j = 0; j < nodes_; ++j) {
      for (int i = 0; i < nodes_; ++i) {
        const auto place = [&](int n) {
          return 2 * static_cast<float>(n) / static_cast<float>(nodes_ - 1) - 1;
        };
        vec3 d;
        d[axis] = face % 2 == 0 ? 1.0f : -1.0f;
        d[(axis + 1) % 3] = place(i);
        d[(axis + 2) % 3] = place(j);
        d = glm::normalize(d);
        x.push_back(d.x), y.push_back(d.y), z.push_back(d.z);
      }
    }
  }
  basis_.resize(x.size() * static_cast<std::size_t>(sh::coefficient_count(degree)));
  sh::eval_basis(degree, x, y, z, basis_);
}

std::vector<float> LobeGrid::evaluate(std::span<const float> values) const {
  const std::size_t places = basis_.size() / static_cast<std::size_t>(sh::coefficient_count(degree_));
  std::vector<float> out(places, 0.0f);
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (values[k] == 0) continue;
    const float* basis = basis_.data() + k * places;
    for (std::size_t i = 0; i < places; ++i) out[i] += values[k] * basis[i];
  }
  return out;
}

LobeTable::LobeTable(const LobeGrid& grid, std::span<const float> values)
    : nodes_(grid.nodes()), table_(grid.evaluate(values)) {
  for (const float value : table_) most_ = std::max(most_, std::abs(value));
}

float LobeTable::at(const vec3& direction) const {
  const vec3 size = glm::abs(direction);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const float scale = 0.5f * static_cast<float>(nodes_ - 1);
  const float u = scale * (direction[(axis + 1) % 3] / size[axis] + 1);
  const float v = scale * (direction[(axis + 2) % 3] / size[axis] + 1);
  const int i = std::clamp(static_cast<int>(u), 0, nodes_ - 2),
            j = std::clamp(static_cast<int>(v), 0, nodes_ - 2);
  const float s = u - static_cast<float>(i), t = v - static_cast<float>(j);
  const int face = 2 * axis + (direction[axis] < 0 ? 1 : 0);
  const float* at = table_.data() + (face * nodes_ + j) * nodes_ + i;
  return (1 - t) * ((1 - s) * at[0] + s * at[1]) + t * ((1 - s) * at[nodes_] + s * at[nodes_ + 1]);
}

std::vector<LobeTable> lobe_tables(std::span<const Lobe> lobes) {
  std::vector<LobeTable> tables;
  if (lobes.empty()) return tables;
  int degree = 0;
  for (const Lobe& lobe : lobes) degree = std::max(degree, degree_of(lobe));
  const LobeGrid grid(degree);
  for (const Lobe& lobe : lobes) tables.emplace_back(grid, lobe.values);
  return tables;
}

std::vector<float> largest_values(std::span<const Lobe> lobes) {
  std::vector<float> out;
  for (const LobeTable& table : lobe_tables(lobes)) out.push_back(table.most());
  return out;
}

}  // namespace ssphh::sketch
