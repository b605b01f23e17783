#pragma once
/// A round room with a ball that flies through it, in closed form: no triangle's edge to hit or to miss.

#include <atomic>
#include <cmath>

#include <ssphh/core/sphere.h>
#include <ssphh/rays/transport_source.h>

// What all tests share is found as test::name beside these, too.
namespace ssphh::test {}
namespace ssphh::transport::test {
using namespace ssphh::test;

/// Both spheres about their part's origin. The walls are of two colours, one half each, and their upper cap
/// glows, as does the ball's; a lamp lights both.
class BallRoom final : public rays::TransportSource {
 public:
  static constexpr double room = 2, ball = 0.45;

  int part_count() const override { return 2; }
  const std::string& part_name(int part) const override { return names_[part]; }
  scene::Bounds part_bounds(int part) const override {
    const auto r = static_cast<float>(part == 0 ? room : ball);
    return {vec3(-r), vec3(r)};
  }
  float duration() const override { return 1; }
  mat4 part_pose(int part, float time) const override {
    if (part == 0) return mat4(1);
    const vec3 place =
        glm::mix(vec3(-0.9f, -0.3f, 0.2f), vec3(0.8f, 0.25f, -0.35f), glm::clamp(time, 0.0f, 1.0f));
    return glm::rotate(glm::translate(mat4(1), place), 0.7f * time, glm::normalize(vec3(1, 2, 0.5f)));
  }
  std::vector<rays::PartPoint> sample_part(int part, double density) const override {
    const int count = std::max(1, static_cast<int>(4 * pi_d * ball * ball * density));
    std::vector<rays::PartPoint> points;
    for (int i = 0; i < count; ++i) {
      const vec3 n = spherical_fibonacci(i, count);
      points.push_back({{static_cast<float>(ball) * n, n}, albedo(part, n), false});
    }
    return points;
  }
  void intersect(int part, std::span<const rays::RayQuery> rays,
                 std::span<rays::RayHit> hits) const override {
    for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = meet(part, rays[i]);
    traced_ += rays.size();
  }
  void occluded(int part, std::span<const rays::RayQuery> rays,
                std::span<std::uint8_t> blocked) const override {
    for (std::size_t i = 0; i < rays.size(); ++i) blocked[i] = !meet(part, rays[i]).escaped();
    traced_ += rays.size();
  }
  const std::vector<std::string>& light_groups() const override { return groups_; }
  std::vector<scene::LightState> lights(float) const override {
    return {{glm::translate(mat4(1), vec3(0.3f, 0.9f, -0.2f)), vec3(1, 0.8f, 0.6f), 5}};
  }
  const std::vector<std::string>& light_names() const override { return lamps_; }
  int light_group_of(int) const override { return 0; }
  bool group_emits_from(int group, int) const override { return group == 1; }
  std::unique_ptr<rays::DirectLight> direct_light(std::span<const scene::LightState> lights,
                                                  std::span<const mat4> poses,
                                                  const scene::EnvironmentState&) const override {
    return std::make_unique<Direct>(*this, lights[0], poses[1]);
  }
  std::uint64_t rays_traced() const override { return traced_; }

 private:
  struct Direct final : rays::DirectLight {
    Direct(const BallRoom& room_in, const scene::LightState& lamp_in, const mat4& ball_in)
        : room(room_in), lamp(lamp_in), to_ball(glm::inverse(ball_in)), at_ball(ball_in[3]) {}
    /// The second group's is made up: no matter, as long as the ball moves it.
    void irradiance(int group, std::span<const rays::SurfacePoint> points,
                    std::span<vec3> out) const override {
      for (std::size_t i = 0; i < points.size(); ++i) {
        const vec3 &x = points[i].position, &n = points[i].normal, way = vec3(lamp.world[3]) - x;
        const float d2 = glm::dot(way, way), cosine = glm::dot(n, way) / std::sqrt(d2);
        if (group == 0) {
          const vec3 from = x + 1e-3f * n;
          const rays::RayQuery ray{vec3(to_ball * vec4(from, 1)), mat3(to_ball) * way, 1};
          const bool dark = !(cosine > 0) || !room.meet(1, ray).escaped();
          out[i] = dark ? vec3(0) : lamp.intensity * lamp.color * (cosine / d2);
        } else {
          out[i] = vec3(1, 0.7f, 0.4f) * (1 + n.y) + vec3(0.2f, 0.4f, 0.6f) / (1 + glm::distance(x, at_ball));
        }
      }
      room.traced_ += points.size();
    }
    bool may_shadow(int group, const rays::SurfacePoint& p, const scene::Bounds& box) const override {
      return group == 1 || glm::dot(vec3(lamp.world[3]) - p.position, p.normal) > 0 || box.empty();
    }
    vec3 emitted(int group, const rays::RayQuery& ray, float) const override {
      return group == 0 ? vec3(0.1f, 0.2f, 0.3f) * (1 + glm::normalize(ray.direction).x) : vec3(0);
    }
    const BallRoom& room;
    scene::LightState lamp;
    mat4 to_ball;
    vec3 at_ball;
  };

  static vec3 albedo(int part, const vec3& outward) {
    if (part == 1) return {0.3f, 0.6f, 0.5f};
    return outward.x > 0.1f ? vec3(0.7f, 0.4f, 0.2f) : vec3(0.25f, 0.5f, 0.75f);
  }
  rays::RayHit meet(int part, const rays::RayQuery& ray) const {
    const glm::dvec3 o(ray.origin), d(ray.direction);
    const double r = part == 0 ? room : ball, a = glm::dot(d, d), b = glm::dot(o, d),
                 c = glm::dot(o, o) - r * r;
    const double root = b * b - a * c;
    rays::RayHit hit;
    if (!(root > 0) || !(a > 0)) return hit;
    const double near = (-b - std::sqrt(root)) / a, far = (-b + std::sqrt(root)) / a;
    const double t = near > 0 ? near : far;
    if (!(t > 0) || t >= static_cast<double>(ray.t_max)) return hit;
    const vec3 outward = glm::normalize(vec3(o + t * d));
    hit.distance = static_cast<float>(t);
    hit.normal = near > 0 ? outward : -outward;
    hit.albedo = albedo(part, outward);
    hit.back = (part == 0) == (near > 0);
    const bool glows = outward.y > (part == 0 ? 0.75f : 0.55f);
    if (glows) hit.emission = part == 0 ? vec3(2, 1.5f, 1) : vec3(0.5f, 1, 2), hit.group = 1;
    return hit;
  }

  std::vector<std::string> names_ = {"room", "ball"}, groups_ = {"lamp", "caps"}, lamps_ = {"lamp"};
  mutable std::atomic<std::uint64_t> traced_ = 0;
};

}  // namespace ssphh::transport::test
