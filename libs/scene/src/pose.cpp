#include <algorithm>

#include <glm/gtc/matrix_transform.hpp>

#include <ssphh/core/require.h>
#include <ssphh/scene/query.h>

#include "check_indices.h"

namespace ssphh::scene {
namespace {

quat to_quat(const vec4& xyzw) {
  return quat(xyzw.w, xyzw.x, xyzw.y, xyzw.z);
}

/// Value of key k: the middle one of three for a cubic spline.
vec4 key_value(const AnimationChannel& channel, std::size_t k) {
  return channel.values[channel.interpolation == Interpolation::cubic_spline ? 3 * k + 1 : k];
}

/// Between keys k and k + 1 at s in [0, 1].
vec4 interpolate(const AnimationChannel& channel, std::size_t k, float s) {
  const vec4 a = key_value(channel, k), b = key_value(channel, k + 1);
  switch (channel.interpolation) {
    case Interpolation::step:
      return a;
    case Interpolation::linear: {
      if (channel.path != AnimationPath::rotation) return a + s * (b - a);
      const quat q = glm::slerp(to_quat(a), to_quat(b), s);
      return {q.x, q.y, q.z, q.w};
    }
    case Interpolation::cubic_spline: {
      // glTF 2.0, appendix C.4: Hermite spline whose tangents are scaled by the keys' distance in time.
      const float dt = channel.times[k + 1] - channel.times[k];
      const vec4 out_tangent = channel.values[3 * k + 2], in_tangent = channel.values[3 * k + 3];
      const float s2 = s * s, s3 = s2 * s;
      return (2 * s3 - 3 * s2 + 1) * a + dt * (s3 - 2 * s2 + s) * out_tangent + (3 * s2 - 2 * s3) * b +
             dt * (s3 - s2) * in_tangent;
    }
  }
  return a;
}

vec4 evaluate(const AnimationChannel& channel, float time) {
  const std::vector<float>& times = channel.times;
  const auto next = std::ranges::upper_bound(times, time);
  if (next == times.begin()) return key_value(channel, 0);
  if (next == times.end()) return key_value(channel, times.size() - 1);
  const auto k = static_cast<std::size_t>(next - times.begin()) - 1;
  return interpolate(channel, k, (time - times[k]) / (times[k + 1] - times[k]));
}

void apply(const AnimationChannel& channel, float time, Transform& local) {
  const vec4 value = evaluate(channel, time);
  if (channel.path == AnimationPath::translation) local.translation = vec3(value);
  if (channel.path == AnimationPath::scale) local.scale = vec3(value);
  if (channel.path == AnimationPath::rotation) {
    const quat q = to_quat(value);
    const float length = glm::length(q);
    local.rotation = length > 0 ? q / length : quat(1, 0, 0, 0);
  }
}

}  // namespace

mat4 Transform::matrix() const {
  mat4 m = glm::mat4_cast(rotation);
  m[0] *= scale.x, m[1] *= scale.y, m[2] *= scale.z;
  m[3] = vec4(translation, 1);
  return m;
}

std::vector<mat4> world_matrices(const Scene& scene, float time) {
  check_nodes(scene);
  // Pose the animated nodes.
  std::vector<Transform> locals;
  locals.reserve(scene.nodes.size());
  for (const Node& node : scene.nodes) locals.push_back(node.local);
  for (const Animation& animation : scene.animations) {
    for (const AnimationChannel& channel : animation.channels) {
      apply(channel, time, locals[channel.node]);
    }
  }
  // Multiply down the tree: parents stand before their children.
  std::vector<mat4> world;
  world.reserve(scene.nodes.size());
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const Node& node = scene.nodes[i];
    const mat4 local = node.matrix ? *node.matrix : locals[i].matrix();
    world.push_back(node.parent < 0 ? local : world[node.parent] * local);
  }
  return world;
}

mat4 world_matrix(const Scene& scene, int index, float time) {
  require(index >= 0 && static_cast<std::size_t>(index) < scene.nodes.size(), "node",
          "there is none of that index");
  const Node& node = scene.nodes[index];
  require(node.parent < index, "node", "its parent does not stand before it");
  mat4 local(1);
  if (node.matrix) {
    local = *node.matrix;
  } else {
    Transform posed = node.local;
    for (const Animation& animation : scene.animations) {
      for (const AnimationChannel& channel : animation.channels) {
        if (channel.node == index) apply(channel, time, posed);
      }
    }
    local = posed.matrix();
  }
  return node.parent < 0 ? local : world_matrix(scene, node.parent, time) * local;
}

float animation_duration(const Scene& scene) {
  float duration = 0;
  for (const Animation& animation : scene.animations) {
    for (const AnimationChannel& channel : animation.channels) {
      if (!channel.times.empty()) duration = std::max(duration, channel.times.back());
    }
  }
  for (const Light& light : scene.lights) duration = std::max(duration, emission_end(light.emission));
  return duration;
}

void mark_movable(Scene& scene) {
  for (Node& node : scene.nodes) node.movable = false;
  for (const Animation& animation : scene.animations) {
    for (const AnimationChannel& channel : animation.channels) {
      scene.nodes[channel.node].movable = true;
    }
  }
  for (Node& node : scene.nodes) {
    if (node.parent >= 0 && scene.nodes[node.parent].movable) node.movable = true;
  }
}

}  // namespace ssphh::scene
