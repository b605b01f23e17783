#pragma once
/// Lamps without an extent above the stage, and the light that arrives from them by closed forms.

#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include <ssphh/trace/transport_scene.h>

#include "pixel_points.h"
#include "stage.h"

namespace ssphh::test {

/// What the stage's surfaces reflect of a lamp without an extent: its irradiance on a surface that faces it
/// and the way to it, both by hand.
struct Arriving {
  vec3 irradiance, wi;
  float distance;
};
using Lamp = std::function<Arriving(const vec3& x)>;

struct StageLamp {
  const char* name;
  scene::Light light;
  Lamp arriving;
};
inline void PrintTo(const StageLamp& c, std::ostream* out) {
  *out << c.name;
}

inline Arriving toward(const vec3& x, const vec3& intensity) {
  const vec3 d = stage_lamp_place - x;
  const float d2 = glm::dot(d, d);
  return {intensity / d2, d / std::sqrt(d2), std::sqrt(d2)};
}

inline std::vector<StageLamp> lamps_without_extent() {
  const vec3 colour(1, 0.8f, 0.3f);
  scene::Light point, spot, sun;
  point.color = spot.color = sun.color = colour;
  point.intensity = spot.intensity = 20, sun.intensity = 3;
  point.type = scene::LightType::point, spot.type = scene::LightType::spot,
  sun.type = scene::LightType::directional;
  spot.inner_cone = 0.3f, spot.outer_cone = 0.7f, spot.range = 9;
  // 20 colour (0.75 + 0.5 z + c x) in the lamp's axes, z against the way it looks, c another for each colour
  const vec3 sideways(0.25f, -0.1f, 0.15f);
  scene::Light lobe = point;
  lobe.type = scene::LightType::sphl, lobe.radius = 0.01f;
  lobe.emission.frames = {sh::IntensitySh(1)};
  lobe.emission.frames[0].values = {vec3(0.75f * 3.5449077f), vec3(0), vec3(0.5f / 0.4886025f),
                                    sideways / 0.4886025f};
  // I = f(θ) + h(θ) g(φ) from the aim and about it, all linear between the angles of the table
  const auto line = [](float x, std::initializer_list<vec2> knots) {
    vec2 last = *knots.begin();
    for (const vec2& next : knots) {
      if (x <= next.x && next.x > last.x)
        return glm::mix(last.y, next.y, glm::clamp((x - last.x) / (next.x - last.x), 0.0f, 1.0f));
      last = next;
    }
    return last.y;
  };
  const auto share = [=](float polar, float turn) {
    return line(polar, {{0, 0.8f}, {40, 0.6f}, {90, 0.1f}, {120, 0}, {180, 0}}) +
           line(polar, {{0, 0}, {40, 0.4f}, {90, 0.1f}, {120, 0}, {180, 0}}) *
               line(turn, {{0, 1}, {90, 0}, {180, 0.5f}, {270, 0.25f}, {360, 1}});
  };
  scene::PhotometricTable measured;
  measured.polar = {0, 40, 90, 120, 180}, measured.turn = {0, 90, 180, 270, 360};
  for (const float turn : measured.turn)
    for (const float polar : measured.polar) measured.candela.push_back(130 * share(polar, turn));
  scene::Light profiled = point, profiled_spot = spot, flood = point;
  profiled.profile = {"c", std::make_shared<const scene::PhotometricTable>(measured)};
  profiled_spot.profile = profiled.profile;
  // H degrees right of the aim in planes V degrees above it: 1 − |H|/100 − |V|/160
  scene::PhotometricTable aimed{scene::Photometry::b, {40, 90, 140}, {-70, 0, 70}, {}};
  for (const float v : aimed.turn)
    for (const float polar : aimed.polar)
      aimed.candela.push_back(1 - std::abs(polar - 90) / 100 - std::abs(v) / 160);
  flood.profile = {"b", std::make_shared<const scene::PhotometricTable>(aimed)};
  const auto in_axes = [](const vec3& wi) {  // of the lamp, away from it
    return -wi * glm::mat3_cast(glm::quatLookAt(stage_lamp_axis, vec3(0, 1, 0)));
  };
  const auto through_profile = [=](const vec3& wi) {
    const vec3 d = in_axes(wi);
    const float turn = glm::degrees(std::atan2(d.y, d.x));
    return share(glm::degrees(std::acos(-d.z)), turn < 0 ? turn + 360 : turn);
  };
  return {{"Point", point, [=](const vec3& x) { return toward(x, 20.0f * colour); }},
          {"Spot", spot,
           [=](const vec3& x) {
             // KHR_lights_punctual
             Arriving a = toward(x, 20.0f * colour);
             const float cosine = -glm::dot(a.wi, stage_lamp_axis), outer = std::cos(0.7f),
                         inner = std::cos(0.3f);
             const float cone = glm::clamp((cosine - outer) / (inner - outer), 0.0f, 1.0f);
             a.irradiance *= cone * cone * glm::clamp(1 - std::pow(a.distance / 9, 4.0f), 0.0f, 1.0f);
             return a;
           }},
          {"Profile", profiled,
           [=](const vec3& x) {
             Arriving a = toward(x, 20.0f * colour);
             a.irradiance *= through_profile(a.wi);
             return a;
           }},
          {"ProfileOfASpot", profiled_spot,
           [=](const vec3& x) {
             Arriving a = toward(x, 20.0f * colour);
             const float cosine = -glm::dot(a.wi, stage_lamp_axis), outer = std::cos(0.7f),
                         inner = std::cos(0.3f);
             const float cone = glm::clamp((cosine - outer) / (inner - outer), 0.0f, 1.0f);
             a.irradiance *= cone * cone * glm::clamp(1 - std::pow(a.distance / 9, 4.0f), 0.0f, 1.0f) *
                             through_profile(a.wi);
             return a;
           }},
          {"Floodlight", flood,
           [=](const vec3& x) {
             Arriving a = toward(x, 20.0f * colour);
             const vec3 d = in_axes(a.wi);
             const float right = std::abs(glm::degrees(std::asin(d.x))),
                         above = std::abs(glm::degrees(std::atan2(d.y, -d.z)));
             a.irradiance *= right > 50 || above > 70 ? 0 : 1 - right / 100 - above / 160;
             return a;
           }},
          {"Sphl", lobe,
           [=](const vec3& x) {
             Arriving a = toward(x, 20.0f * colour);
             const mat3 axes = glm::mat3_cast(glm::quatLookAt(stage_lamp_axis, vec3(0, 1, 0)));
             a.irradiance *= 0.75f - 0.5f * glm::dot(a.wi, axes[2]) - sideways * glm::dot(a.wi, axes[0]);
             return a;
           }},
          {"Sun", sun, [=](const vec3&) {
             return Arriving{3.0f * colour, -stage_lamp_axis, 100};
           }}};
}

/// Of a matte surface, for an irradiance of 1 that arrives from wi.
inline vec3 lambertian(const PixelPoint& p, const vec3& wi) {
  return p.hit.albedo / pi * std::max(glm::dot(stage_normal(p.point), wi), 0.0f);
}

/// Radiance of the stage by one lamp at the middle of every pixel. `reflected(pixel, wi)`: as lambertian.
struct LampPicture {
  template <class Reflected>
  LampPicture(const scene::Scene& scene, PictureSize size, const Lamp& lamp, const Reflected& reflected)
      : source(scene), points(source, scene::camera_pose(scene, ""), size) {
    const rays::PosedWorld surfaces(source, 0);
    for (const PixelPoint& p : points.pixels) {
      const Arriving a = lamp(p.point.position);
      lit.push_back(
          !p.hit.escaped() && glm::dot(p.point.normal, a.wi) > 0 && max_component(a.irradiance) > 0 &&
          surfaces.visible(p.point.position + 1e-4f * p.point.normal, p.point.position + a.distance * a.wi));
    }
    picture = points.picture([&](const PixelPoint& p) {
      const Arriving a = lamp(p.point.position);
      return lit[points.index(p)] ? a.irradiance * reflected(p, a.wi) : vec3(0);
    });
    edge = points.edges([&](std::size_t a, std::size_t b) { return lit[a] != lit[b]; });
  }
  bool edge_at(int x, int y) const { return edge[y * points.size.width + x]; }

  trace::TransportScene source;
  PixelPoints points;
  std::vector<bool> lit;
  std::vector<bool> edge;  ///< of a shadow, at the pixel or beside it
  image::Image picture;
};

}  // namespace ssphh::test
