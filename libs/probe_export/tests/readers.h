#pragma once
/// What engines do with the files, written from their shaders' descriptions.

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include <ssphh/core/json.h>

#include "field_sets.h"

namespace ssphh::probe_export {

inline vec3 triple(const json::Value& v) {
  return {static_cast<float>(v[0].number()), static_cast<float>(v[1].number()),
          static_cast<float>(v[2].number())};
}

/// three.js r187, lightprobes_pars_fragment: E(n) at a surface.
class ThreeReader {
 public:
  explicit ThreeReader(const Exported& exported) {
    const json::Value header = json::parse(text_of(exported.files.at(0)), "header");
    low_ = triple(header["min"]), high_ = triple(header["max"]), resolution_ = triple(header["resolution"]);
    const json::Value& t = header["texture"];
    texture_ = texture({*t["width"].integer(), *t["height"].integer(), *t["depth"].integer()},
                       exported.files.at(1).data);
    EXPECT_EQ(exported.files[1].data.size(),
              static_cast<std::size_t>(8 * texture_.size.x * texture_.size.y * texture_.size.z));
  }

  vec3 cell() const { return (high_ - low_) / resolution_; }
  /// Whether the grid lights the place at all.
  bool holds(const vec3& at, const vec3& n) const {
    const vec3 place = at + 0.5f * cell() * n, more = 0.01f * cell();
    return glm::all(glm::greaterThanEqual(place, low_ - more)) &&
           glm::all(glm::lessThanEqual(place, high_ + more));
  }
  vec3 irradiance(const vec3& at, const vec3& n) const {
    const vec3 range = high_ - low_, place = at + 0.5f * range / resolution_ * n;
    const vec3 uvw = glm::clamp((place - low_) / range, 0.5f / resolution_, 1.0f - 0.5f / resolution_);
    const float padded = resolution_.z + 2;
    float numbers[28];
    for (int t = 0; t < 7; ++t) {
      const float z = (uvw.z * resolution_.z + 1 + static_cast<float>(t) * padded) / (7 * padded);
      const vec4 four = texture_.sample({uvw.x, uvw.y, z});
      for (int c = 0; c < 4; ++c) numbers[4 * t + c] = four[c];
    }
    const auto c = [&](int k) { return vec3(numbers[3 * k], numbers[3 * k + 1], numbers[3 * k + 2]); };
    vec3 e = c(0) * 0.886227f;
    e += 2 * 0.511664f * (c(1) * n.y + c(2) * n.z + c(3) * n.x);
    e += 2 * 0.429043f * (c(4) * n.x * n.y + c(5) * n.y * n.z + c(7) * n.x * n.z);
    e += c(6) * (0.743125f * n.z * n.z - 0.247708f) + c(8) * 0.429043f * (n.x * n.x - n.y * n.y);
    return glm::max(e, vec3(0));
  }

 private:
  vec3 low_, high_, resolution_;
  Texture3 texture_;
};

/// Bevy, irradiance_volume.wgsl: E(n)/π at a place.
class BevyReader {
 public:
  explicit BevyReader(const Exported& exported) {
    const json::Value place = json::parse(text_of(exported.files.at(1)), "place");
    translation_ = triple(place["translation"]), scale_ = triple(place["scale"]);
    ByteReader file(exported.files.at(0).data, "ktx2");
    file.view("identifier", 12);
    EXPECT_EQ(file.value<std::uint32_t>("format"), 97u);  // VK_FORMAT_R16G16B16A16_SFLOAT
    EXPECT_EQ(file.value<std::uint32_t>("type size"), 2u);
    glm::ivec3 size;
    for (int axis = 0; axis < 3; ++axis) size[axis] = static_cast<int>(file.value<std::uint32_t>("size"));
    file.view("to the level index", 80 - 32);
    const auto at = file.value<std::uint64_t>("offset"), bytes = file.value<std::uint64_t>("length");
    EXPECT_EQ(at % 8, 0u);
    EXPECT_EQ(at + bytes, exported.files[0].data.size());
    texture_ = texture(size, std::span(exported.files[0].data).subspan(at, bytes));
  }

  vec3 diffuse(const vec3& at, const vec3& n) const {
    const vec3 atlas(texture_.size), resolution = atlas / vec3(1, 2, 3);
    const vec3 unit = (at - translation_) / scale_;
    const vec3 uvw = glm::clamp((unit + 0.5f) * resolution, vec3(0.5f), resolution - 0.5f) / atlas;
    vec3 sum(0);
    for (int axis = 0; axis < 3; ++axis) {
      const float below = n[axis] < 0 ? 0.5f : 0.0f;
      sum += n[axis] * n[axis] * vec3(texture_.sample(uvw + vec3(0, below, static_cast<float>(axis) / 3)));
    }
    return sum;
  }

 private:
  vec3 translation_, scale_;
  Texture3 texture_;
};

/// What docs/engines.md asks a page to do for an object: nine colours between the eight points around it.
class ObjectGridReader {
 public:
  ObjectGridReader(const Exported& exported, const std::string& format) {
    const json::Value header = json::parse(text_of(exported.files.at(0)), "header");
    EXPECT_EQ(header["format"].string(), format);
    EXPECT_EQ(header["light"]["file"].string(), "grid.bin");
    EXPECT_EQ(header["light"]["type"].string(), "float32");
    EXPECT_EQ(header["light"]["numbers"].integer(), 27);
    low_ = triple(header["min"]), high_ = triple(header["max"]), size_ = triple(header["resolution"]);
    const std::vector<std::byte>& data = exported.files.at(1).data;
    numbers_.resize(data.size() / sizeof(float));
    std::memcpy(numbers_.data(), data.data(), data.size());
    EXPECT_EQ(data.size(), static_cast<std::size_t>(4 * 27 * size_.x * size_.y * size_.z));
  }

  vec3 cell() const { return (high_ - low_) / vec3(size_); }
  std::array<vec3, 9> colors(const vec3& at) const {
    const vec3 place = glm::clamp((at - low_) / cell() - 0.5f, vec3(0), vec3(size_ - 1));
    const vec3 low = glm::floor(place), t = place - low;
    std::array<vec3, 9> sum = {};
    for (int k = 0; k < 8; ++k) {
      const glm::ivec3 step(k & 1, k >> 1 & 1, k >> 2);
      const glm::ivec3 point = glm::min(glm::ivec3(low) + step, size_ - 1);
      const vec3 share = glm::mix(1.0f - t, t, glm::bvec3(step));
      const int index = (point.z * size_.y + point.y) * size_.x + point.x;
      for (std::size_t c = 0; c < 9; ++c) {
        const float* color = numbers_.data() + 27 * static_cast<std::size_t>(index) + 3 * c;
        sum[c] += share.x * share.y * share.z * vec3(color[0], color[1], color[2]);
      }
    }
    return sum;
  }

 private:
  vec3 low_, high_;
  glm::ivec3 size_;
  std::vector<float> numbers_;
};

/// Babylon.js 9.35, SphericalHarmonics.preScaleForRendering and computeEnvironmentIrradiance: what a surface
/// multiplies with its albedo.
inline vec3 babylon_diffuse(const std::array<vec3, 9>& sh, const vec3& n) {
  return 0.282095f * sh[0] - 0.488603f * n.y * sh[1] + 0.488603f * n.z * sh[2] - 0.488603f * n.x * sh[3] +
         1.092548f * n.x * n.y * sh[4] - 1.092548f * n.y * n.z * sh[5] +
         0.315392f * (3 * n.z * n.z - 1) * sh[6] - 1.092548f * n.z * n.x * sh[7] +
         0.546274f * (n.x * n.x - n.y * n.y) * sh[8];
}

/// PlayCanvas 2.23, the chunk ambientPS: likewise.
inline vec3 playcanvas_diffuse(const std::array<vec3, 9>& sh, const vec3& n) {
  const vec3 color = sh[0] + sh[1] * n.x + sh[2] * n.y + sh[3] * n.z + sh[4] * n.x * n.z + sh[5] * n.z * n.y +
                     sh[6] * n.y * n.x + sh[7] * (3.0f * n.z * n.z - 1.0f) + sh[8] * (n.x * n.x - n.y * n.y);
  return glm::max(color, vec3(0));
}

/// Unity, SphericalHarmonicsL2 of a probe: what SHEvalLinearL0L1 and SHEvalLinearL2 of its shaders sum, of
/// constants as the engine sets them for an object (unity_SHAr and so on): E(n)/π, in Unity's axes.
inline vec3 unity_diffuse(const json::Value& light, std::size_t probe, const vec3& n) {
  vec3 color;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const auto c = [&](std::size_t k) {
      return static_cast<float>(light[27 * probe + 9 * channel + k].number());
    };
    const vec4 a(c(3), c(1), c(2), c(0) - c(6)), b(c(4), c(5), 3 * c(6), c(7));
    color[static_cast<int>(channel)] = glm::dot(a, vec4(n, 1)) +
                                       glm::dot(b, vec4(n.x * n.y, n.y * n.z, n.z * n.z, n.z * n.x)) +
                                       c(8) * (n.x * n.x - n.y * n.y);
  }
  return color;
}

/// A GLB file with the extension SSPHH_light_probes, read as docs/engines/gltf.md tells.
struct GltfReader {
  json::Value document;
  std::vector<vec3> places;
  std::vector<std::vector<vec3>> light;  ///< coefficients of radiance

  explicit GltfReader(const Exported& exported) {
    const std::vector<std::byte>& data = exported.files.at(0).data;
    ByteReader file(data, "glb");
    const auto words = [&file](std::size_t size) {
      return std::string_view(reinterpret_cast<const char*>(file.view("words", size).data()), size);
    };
    EXPECT_EQ(words(4), "glTF");
    EXPECT_EQ(file.value<std::uint32_t>("version"), 2u);
    EXPECT_EQ(file.value<std::uint32_t>("length"), data.size());
    const auto text = file.value<std::uint32_t>("length of the JSON chunk");
    EXPECT_EQ(text % 4, 0u);
    EXPECT_EQ(words(4), "JSON");
    document = json::parse(words(text), "glb");
    const auto binary = file.value<std::uint32_t>("length of the binary chunk");
    EXPECT_EQ(binary, file.left() - 4);
    EXPECT_EQ(words(4), std::string_view("BIN\0", 4));

    const json::Value& probes = document["extensions"]["SSPHH_light_probes"];
    const json::Value& accessor = document["accessors"][static_cast<int>(*probes["radiance"].integer())];
    const auto count =
        static_cast<std::size_t>((*probes["degree"].integer() + 1) * (*probes["degree"].integer() + 1));
    EXPECT_EQ(*accessor["count"].integer(), static_cast<std::int64_t>(count * probes["probes"].size()));
    EXPECT_EQ(*document["buffers"][0]["byteLength"].integer(), 12 * *accessor["count"].integer());
    for (const json::Value& probe : probes["probes"].elements()) {
      places.push_back(triple(document["nodes"][static_cast<int>(*probe["node"].integer())]["translation"]));
      std::vector<vec3>& values = light.emplace_back();
      for (std::size_t k = 0; k < count; ++k) values.push_back(file.vector3("radiance"));
    }
  }
};

/// Irradiance of radiance of degree 2 (docs/conventions.md).
inline vec3 irradiance_of(std::span<const vec3> c, const vec3& n) {
  vec3 e = 0.886227f * c[0] + 1.023327f * (c[1] * n.y + c[2] * n.z + c[3] * n.x);
  e += 0.858086f * (c[4] * n.x * n.y + c[5] * n.y * n.z + c[7] * n.x * n.z);
  return e + c[6] * (0.743125f * n.z * n.z - 0.247708f) + c[8] * 0.429043f * (n.x * n.x - n.y * n.y);
}

}  // namespace ssphh::probe_export
