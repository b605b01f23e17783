#include "gather_guide.h"

#include <algorithm>
#include <cmath>

#include <ssphh/core/random.h>
#include <ssphh/core/sphere.h>

namespace ssphh::transport {
namespace {

/// Bright surfels that a place is guided by, and before those that nothing sees are left out; patches that
/// rays met.
constexpr std::size_t most_bright = 256, most_asked = 1024, most_met = 256;
/// Of the rays that are guided, the share that is not.
constexpr float even_share = 0.25f;

float patch_area(const TransportNetwork::Data& d, std::size_t patch) {
  const std::size_t surfel = patch / d.sample_count();
  const float size = d.surfels.size(d.surfels.surfels()[surfel].level);
  return size * size / static_cast<float>(d.used_samples(surfel));
}

}  // namespace

HemisphereParts::HemisphereParts(std::uint32_t rays) {
  rings_ = std::max(1u, static_cast<std::uint32_t>(std::sqrt(static_cast<float>(rays) / 8)));
  sectors_ = 4 * rings_;
}

std::size_t HemisphereParts::part_of(const vec3& local) const {
  const float u = local.x * local.x + local.y * local.y;
  const float turn = std::atan2(local.y, local.x) / (2 * pi), v = turn < 0 ? turn + 1 : turn;
  const auto at = [](float x, std::uint32_t count) {
    return std::min(static_cast<std::uint32_t>(x * static_cast<float>(count)), count - 1);
  };
  return std::size_t{at(u, rings_)} * sectors_ + at(v, sectors_);
}

vec3 HemisphereParts::direction(std::size_t part, std::uint32_t index, std::uint64_t salt) const {
  const std::uint64_t h = hash_combine(salt, part);
  const double u = 0.7548776662466927 * (index + 1) + static_cast<double>(h >> 32) * 0x1p-32;
  const double v = 0.5698402909980532 * (index + 1) + static_cast<double>(h & 0xffffffffu) * 0x1p-32;
  const vec2 within(static_cast<float>(u - std::floor(u)), static_cast<float>(v - std::floor(v)));
  const vec2 corner(static_cast<float>(part / sectors_), static_cast<float>(part % sectors_));
  const vec2 p = (corner + within) / vec2(static_cast<float>(rings_), static_cast<float>(sectors_));
  return sample_cosine_hemisphere(glm::min(p, vec2(0x1.fffffep-1f)));
}

void HemisphereParts::spread(std::vector<float>& weights) const {
  const std::vector<float> before = weights;
  const auto rings = static_cast<int>(rings_), sectors = static_cast<int>(sectors_);
  for (int ring = 0; ring < rings; ++ring) {
    for (int sector = 0; sector < sectors; ++sector) {
      float around = 0;
      for (int i = -1; i <= 1; ++i) {
        for (int j = -1; j <= 1; ++j) {
          const int from = std::clamp(ring + i, 0, rings - 1), at = (sector + j + sectors) % sectors;
          around += before[from * sectors + at];
        }
      }
      float& weight = weights[ring * sectors + sector];
      weight = 0.5f * weight + around / 18;
    }
  }
}

std::vector<float> patch_flux(const TransportNetwork::Data& d,
                              std::span<const std::vector<Irradiance4>> direct) {
  const std::vector<Surfel>& surfels = d.surfels.surfels();
  const std::size_t m = d.sample_count();
  std::vector<float> flux(d.albedo.size(), 0), of_group(d.albedo.size(), 0);
  for (const std::vector<Irradiance4>& group : direct) {
    double total = 0;
    for (std::size_t s = 0; s < surfels.size(); ++s) {
      for (std::size_t p = s * m; p < s * m + d.used_samples(s); ++p) {
        of_group[p] = luminance(d.albedo[p] * vec3(group[p])) * patch_area(d, p);
        total += of_group[p];
      }
    }
    if (!(total > 0)) continue;
    for (std::size_t p = 0; p < flux.size(); ++p) flux[p] += static_cast<float>(of_group[p] / total);
  }
  return flux;
}

std::vector<std::uint32_t> spatial_order(std::span<const rays::SurfacePoint> points) {
  vec3 low(std::numeric_limits<float>::infinity()), high = -low;
  for (const rays::SurfacePoint& p : points)
    low = glm::min(low, p.position), high = glm::max(high, p.position);
  const float extent = std::max(max_component(high - low), 1e-20f);
  // Bits of the three coordinates in turns (Morton 1966)
  const auto code = [&](const vec3& x) {
    const vec3 at = glm::clamp((x - low) / extent, 0.0f, 1.0f) * 1023.0f;
    std::uint32_t bits = 0;
    for (unsigned b = 0; b < 10; ++b) {
      for (glm::length_t c = 0; c < 3; ++c)
        bits |= (static_cast<std::uint32_t>(at[c]) >> b & 1u) << (3 * b + static_cast<unsigned>(c));
    }
    return bits;
  };
  std::vector<std::pair<std::uint32_t, std::uint32_t>> keys;
  for (std::size_t i = 0; i < points.size(); ++i)
    keys.emplace_back(code(points[i].position), static_cast<std::uint32_t>(i));
  std::ranges::sort(keys);
  std::vector<std::uint32_t> order;
  for (const auto& [key, index] : keys) order.push_back(index);
  return order;
}

namespace {

/// What the brightest surfels hold that are seen, of those that would light the points most.
void add_seen(const TransportNetwork::Data& d, std::span<const float> flux,
              std::span<const rays::SurfacePoint> together, std::vector<std::int32_t>& patches) {
  vec3 middle(0);
  for (const rays::SurfacePoint& p : together) middle += p.position / static_cast<float>(together.size());
  float radius2 = 0;
  for (const rays::SurfacePoint& p : together) {
    const vec3 away = p.position - middle;
    radius2 = std::max(radius2, glm::dot(away, away));
  }
  const std::vector<Surfel>& surfels = d.surfels.surfels();
  const std::size_t m = d.sample_count();
  std::vector<std::pair<float, std::uint32_t>> found;
  for (std::size_t s = 0; s < d.static_count; ++s) {
    const vec3 away = surfels[s].point.position - middle;
    const float size = d.surfels.size(surfels[s].level);
    float leaving = 0;
    for (std::size_t p = s * m; p < (s + 1) * m; ++p) leaving += flux[p];
    const float there = leaving / (glm::dot(away, away) + radius2 + size * size);
    if (there > 0) found.emplace_back(-there, static_cast<std::uint32_t>(s));
  }
  const std::size_t asked = std::min(most_asked, found.size());
  std::ranges::partial_sort(found, found.begin() + static_cast<std::ptrdiff_t>(asked));
  found.resize(asked);

  std::size_t taken = 0;
  for (std::size_t i = 0; i < found.size() && taken < most_bright; ++i) {
    const std::size_t s = found[i].second;
    const rays::SurfacePoint& there = surfels[s].point;
    bool seen = false;
    for (std::size_t k = 0; k < 4 && !seen; ++k) {
      const rays::SurfacePoint& here = together[(i + k * together.size() / 4) % together.size()];
      if (glm::dot(there.position - here.position, here.normal) <= 0 ||
          glm::dot(here.position - there.position, there.normal) <= 0)
        continue;
      seen = !d.blocked(SurfelSet::segment(here, d.surfels.lift(), there, surfels[s].height));
    }
    if (!seen) continue;
    ++taken;
    for (std::size_t p = s * m; p < (s + 1) * m; ++p) patches.push_back(static_cast<std::int32_t>(p));
  }
}

/// What even rays of some of the points meet: a plain outside of a window is large, and next to all of it is
/// hidden.
void add_met(const TransportNetwork::Data& d, std::span<const float> flux,
             std::span<const rays::SurfacePoint> together, std::vector<std::int32_t>& patches) {
  constexpr std::size_t asking = 16;
  const HemisphereParts parts(1024);
  const std::size_t step = (together.size() + asking - 1) / asking;
  std::vector<rays::RayQuery> rays;
  for (std::size_t i = 0; i < together.size(); i += step) {
    const rays::SurfacePoint& point = together[i];
    const Frame frame = Frame::around(point.normal);
    const vec3 origin = point.position + link_lift * d.surfels.size() * point.normal;
    for (std::size_t part = 0; part < parts.count(); ++part)
      rays.push_back({origin, frame.to_world(parts.direction(part, 0, i))});
  }
  std::vector<rays::RayHit> hits(rays.size());
  d.source.intersect(0, rays, hits);
  std::vector<std::int32_t> met;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (!hits[i].escaped())
      met.push_back(d.find_static({rays[i].origin + hits[i].distance * rays[i].direction, hits[i].normal}));
  }
  std::ranges::sort(met);
  std::vector<std::pair<float, std::int32_t>> found;  // less what arrives of it, patch
  for (std::size_t i = 0, next = 0; i < met.size(); i = next) {
    while (next < met.size() && met[next] == met[i]) ++next;
    if (met[i] == no_patch || !(flux[met[i]] > 0)) continue;
    const float radiosity = flux[met[i]] / patch_area(d, static_cast<std::size_t>(met[i]));
    found.emplace_back(-radiosity * static_cast<float>(next - i), met[i]);
  }
  std::ranges::sort(found);
  if (found.size() > most_met) found.resize(most_met);
  for (const auto& [arriving, patch] : found) patches.push_back(patch);
}

}  // namespace

std::vector<BrightPoint> bright_points(const TransportNetwork::Data& d, std::span<const float> flux,
                                       std::span<const rays::SurfacePoint> together) {
  if (std::ranges::none_of(flux, [](float f) { return f > 0; })) return {};
  std::vector<std::int32_t> patches;
  add_seen(d, flux, together, patches);
  add_met(d, flux, together, patches);
  std::ranges::sort(patches);
  patches.erase(std::unique(patches.begin(), patches.end()), patches.end());
  std::vector<BrightPoint> bright;
  for (const std::int32_t p : patches)
    if (flux[p] > 0) bright.push_back({d.samples[p], flux[p]});
  return bright;
}

std::vector<std::uint32_t> rays_of_parts(const HemisphereParts& parts, std::uint32_t rays,
                                         const rays::SurfacePoint& point,
                                         std::span<const BrightPoint> bright) {
  std::vector<float> weights(parts.count(), 0);
  const Frame frame = Frame::around(point.normal);
  double total = 0;
  for (const BrightPoint& b : bright) {
    const vec3 away = b.point.position - point.position;
    const float distance2 = glm::dot(away, away);
    if (!(distance2 > 0)) continue;
    const vec3 local = frame.to_local(away / std::sqrt(distance2));
    const float facing = -glm::dot(away, b.point.normal) / std::sqrt(distance2);
    if (local.z <= 0 || facing <= 0) continue;
    const float light = b.flux * local.z * facing / distance2;
    weights[parts.part_of(local)] += light;
    total += light;
  }
  const auto even = 1 / static_cast<float>(parts.count());
  if (total > 0) {
    parts.spread(weights);
    for (float& w : weights) w = even_share * even + (1 - even_share) * w / static_cast<float>(total);
  } else {
    std::ranges::fill(weights, even);
  }
  const auto extra = static_cast<double>(rays) - static_cast<double>(parts.count());
  std::vector<std::uint32_t> count(parts.count());
  double sum = 0;
  std::uint32_t given = 0;
  for (std::size_t p = 0; p < parts.count(); ++p) {
    sum += weights[p];
    const auto until = p + 1 == parts.count() ? static_cast<std::uint32_t>(extra)
                                              : static_cast<std::uint32_t>(std::min(sum, 1.0) * extra + 0.5);
    count[p] = 1 + until - std::min(given, until);
    given = std::max(given, until);
  }
  return count;
}

}  // namespace ssphh::transport
