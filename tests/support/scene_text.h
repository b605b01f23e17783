#pragma once
/// A scene as text, one line for each of its objects with every field that is not the default.

#include <cmath>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

#include "scene_fields.h"

namespace ssphh::test {

/// A number in [0, 1) for each index, without any pattern.
inline double weight(std::size_t i) {
  auto h = static_cast<std::uint32_t>(i) * 2654435761u + 12345u;
  for (const int shift : {16, 13, 16}) h = (h ^ (h >> shift)) * 2246822519u;
  return static_cast<double>(h) / 4294967296.0;
}

/// The components of n elements: all of them while they are few, else their number and a mean in which each
/// element has another weight, so that neither two of them may be swapped nor all be shifted.
template <class T>
std::string array_text(const T* values, std::size_t n, std::size_t components) {
  std::string text = n == 1 ? "" : fmt::format("{}: ", n);
  if (n * components <= 32) {
    for (std::size_t i = 0; i < n * components; ++i)
      text += fmt::format("{}{:.6g}", i == 0 ? "" : " ", static_cast<double>(values[i]) + 0.0);
    return text;
  }
  for (std::size_t c = 0; c < components; ++c) {
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
      sum += weight(i) * static_cast<double>(values[i * components + c]);
    }
    text += fmt::format("{}{:.6g}", c == 0 ? "" : " ", sum / static_cast<double>(n));
  }
  return text;
}

/// Names may hold line ends.
inline std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) out += c == '\n' ? std::string("\\n") : std::string(1, c);
  return out + "\"";
}

template <class T>
std::string field_text(const T& field) {
  if constexpr (std::is_same_v<T, std::string>) {
    return quoted(field);
  } else if constexpr (std::is_enum_v<T>) {
    return fmt::format("choice {}", static_cast<int>(field));
  } else if constexpr (std::is_same_v<T, bool>) {
    return field ? "yes" : "no";
  } else if constexpr (std::is_arithmetic_v<T>) {
    return fmt::format("{:.6g}", static_cast<double>(field) + 0.0);
  } else if constexpr (std::is_same_v<T, quat>) {
    // q and −q turn alike.
    const quat q = field.w < 0 ? -field : field;
    return array_text(&q.x, 1, 4);
  } else if constexpr (requires { field.has_value(); }) {
    return field ? field_text(*field) : "none";
  } else if constexpr (std::is_same_v<T, mat4>) {
    return array_text(&field[0].x, 4, 4);
  } else if constexpr (std::is_same_v<T, std::vector<std::string>>) {
    std::string text;
    for (const std::string& line : field) text += (text.empty() ? "" : "; ") + quoted(line);
    return text;
  } else if constexpr (requires { field.data(); }) {
    using Item = typename T::value_type;
    if constexpr (std::is_arithmetic_v<Item>) {
      return array_text(field.data(), field.size(), 1);
    } else {
      return array_text(field.empty() ? nullptr : &field.data()->x, field.size(),
                        sizeof(Item) / sizeof(field.data()->x));
    }
  } else {
    return array_text(&field.x, 1, sizeof field / sizeof field.x);
  }
}

/// All fields by path.
inline std::vector<std::pair<std::string, std::string>> field_texts_of(scene::Scene scene) {
  std::vector<std::pair<std::string, std::string>> fields;
  const auto note = [&](const std::string& path, const auto& field) {
    fields.emplace_back(path, field_text(field));
  };
  SceneFields(scene, note);
  return fields;
}

/// As many objects of each kind, without a number of their own.
inline scene::Scene plain_of(const scene::Scene& scene) {
  scene::Scene plain;
  plain.textures.resize(scene.textures.size());
  plain.materials.resize(scene.materials.size());
  plain.meshes.resize(scene.meshes.size());
  plain.nodes.resize(scene.nodes.size());
  plain.instances.resize(scene.instances.size());
  plain.cameras.resize(scene.cameras.size());
  for (const scene::Light& light : scene.lights)
    plain.lights.emplace_back().emission.frames.resize(light.emission.frames.size());
  plain.sphls.resize(scene.sphls.size());
  for (const scene::Animation& animation : scene.animations) {
    plain.animations.emplace_back();
    plain.animations.back().channels.resize(animation.channels.size());
  }
  if (scene.environment) plain.environment.emplace();
  return plain;
}

/// "lights[1] color 1 0.5 0.25 intensity 3", and so on.
inline std::string scene_text(const scene::Scene& scene) {
  const auto fields = field_texts_of(scene), defaults = field_texts_of(plain_of(scene));
  std::string text, object;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const auto& [path, value] = fields[i];
    if (path == "dark_groups" && value.empty()) continue;  // as in nearly all scenes
    const std::size_t dot = path.rfind("].");
    const std::string of =
        dot == std::string::npos ? path.substr(0, path.find('.')) : path.substr(0, dot + 1);
    if (of != object) text += (text.empty() ? "" : "\n") + of;
    object = of;
    if (value != defaults.at(i).second)
      text += " " + path.substr(std::min(path.size(), of.size() + 1)) + " " + value;
  }
  return text + "\n";
}

}  // namespace ssphh::test
