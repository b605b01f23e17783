#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/core/random.h>
#include <ssphh/scene_io/obj.h>

#include "mtl.h"
#include "printable.h"
#include "text_lines.h"
#include "triangulate.h"

namespace ssphh::scene_io {
namespace {

// Indices into the file's arrays; −1: none.
struct Corner {
  int position = -1, uv = -1, normal = -1;
  friend bool operator==(const Corner&, const Corner&) = default;
};

// Statements of the format that have no counterpart here.
constexpr std::array<std::string_view, 24> known_statements = {
    "l",     "p",    "vp",    "cstype",   "deg",      "bmat", "step",       "curv",
    "curv2", "surf", "parm",  "trim",     "hole",     "scrv", "sp",         "end",
    "con",   "mg",   "bevel", "c_interp", "d_interp", "lod",  "shadow_obj", "trace_obj"};

struct CornerHash {
  std::size_t operator()(const Corner& c) const {
    const auto bits = [](int i) { return static_cast<std::uint64_t>(static_cast<std::uint32_t>(i)); };
    return mix64(bits(c.position) ^ mix64((bits(c.uv) << 32) | bits(c.normal)));
  }
};

// Triangles of one object or group with one material, three corners each.
struct Part {
  std::string name;
  int material = -1;
  std::vector<Corner> corners;
};

class ObjReader {
 public:
  ObjReader(std::string_view text, const std::filesystem::path& path)
      : lines_(text), path_(path), materials_(scene_, ignored_) {
    scene_.name = path.stem().string();
  }

  scene::Scene read() {
    while (lines_.next()) {
      std::string_view rest = lines_.line();
      const std::string_view keyword = next_word(rest);
      statement(keyword, rest);
    }
    if (triangle_count_ == 0) throw Error(path_.string(), "holds no faces");
    if (normals_.empty()) ignored_.add("smoothing group without normals", smoothing_groups_);
    for (Part& part : parts_) add_mesh(part);
    scene_.ignored = ignored_.lines();
    return std::move(scene_);
  }

 private:
  [[noreturn]] void fail(const std::string& problem) const {
    throw Error(fmt::format("{}:{}", path_.string(), lines_.number()), problem);
  }

  void statement(std::string_view keyword, std::string_view rest) {
    if (keyword == "v") {
      positions_.push_back(vertex<3>(rest));
    } else if (keyword == "vn") {
      normals_.push_back(vertex<3>(rest));
    } else if (keyword == "vt") {
      const vec3 uv = vertex<1>(rest);
      uvs_.emplace_back(uv.x, 1 - uv.y);
    } else if (keyword == "f" || keyword == "fo") {
      face(rest);
    } else if (keyword == "o" || keyword == "g") {
      group_ = printable(trimmed(rest));
      part_ = nullptr;
    } else if (keyword == "usemtl") {
      material_ = printable(trimmed(rest));
      part_ = nullptr;
    } else if (keyword == "mtllib") {
      library(trimmed(rest));
    } else if (keyword == "s") {
      smoothing_groups_ += trimmed(rest) != "off" && trimmed(rest) != "0";
    } else {
      const bool known = std::ranges::find(known_statements, keyword) != known_statements.end();
      ignored_.add(known ? fmt::format("OBJ statement {}", keyword) : "unknown OBJ statement");
    }
  }

  // Up to three coordinates, of which `Required` must be there.
  template <int Required>
  vec3 vertex(std::string_view rest) const {
    vec3 out(0);
    for (int c = 0; c < 3; ++c) {
      const std::string_view word = next_word(rest);
      if (word.empty() && c >= Required) break;
      const auto value = parse_float(word);
      if (!value)
        fail(word.empty() ? "a coordinate is missing"
                          : fmt::format("\"{}\" is no number", printable(word, 40)));
      if (!std::isfinite(*value)) fail(fmt::format("the coordinate {} is not finite", printable(word, 40)));
      out[c] = *value;
    }
    return out;
  }

  // An index of a face: from 1, or backwards from −1.
  int index(std::string_view word, std::size_t count, const char* noun) const {
    const auto value = parse_integer(word);
    if (!value) fail(fmt::format("\"{}\" is no {} index", printable(word, 40), noun));
    const auto size = static_cast<long long>(count);
    if (*value == 0 || *value > size || *value < -size) {
      fail(fmt::format("{} index {} out of range, {} are defined so far", noun, *value, size));
    }
    return static_cast<int>(*value > 0 ? *value - 1 : size + *value);
  }

  // "p", "p/t", "p//n" or "p/t/n"
  Corner corner(std::string_view word) const {
    Corner out;
    const auto first = word.find('/');
    out.position = index(word.substr(0, first), positions_.size(), "vertex");
    if (first == word.npos) return out;
    word.remove_prefix(first + 1);
    const auto second = word.find('/');
    if (const auto uv = word.substr(0, second); !uv.empty())
      out.uv = index(uv, uvs_.size(), "texture coordinate");
    if (second != word.npos) out.normal = index(word.substr(second + 1), normals_.size(), "normal");
    return out;
  }

  void face(std::string_view rest) {
    corners_.clear();
    for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest))
      corners_.push_back(corner(word));
    if (corners_.size() < 3) {
      ignored_.add("face with fewer than 3 corners");
      return;
    }
    polygon_.clear();
    for (const Corner& c : corners_) polygon_.push_back(positions_[c.position]);
    triangles_.clear();
    triangulate(polygon_, ear_clipping_work_, triangles_);
    Part& part = current_part();
    for (const uvec3& t : triangles_) {
      for (int c = 0; c < 3; ++c) part.corners.push_back(corners_[t[c]]);
    }
    triangle_count_ += triangles_.size();
  }

  Part& current_part() {
    if (part_) return *part_;
    const auto [entry, is_new] = part_of_.try_emplace({group_, material_}, parts_.size());
    if (is_new) {
      const std::string name = group_.empty() ? (material_.empty() ? scene_.name : material_) : group_;
      parts_.push_back({name, materials_.material(material_), {}});
    }
    part_ = &parts_[entry->second];
    return *part_;
  }

  // One file name with blanks, or several names.
  void library(std::string_view names) {
    std::string all(names);
    std::ranges::replace(all, '\\', '/');
    const auto folder = path_.parent_path();
    const auto add = [&](const std::string& name) {
      const std::filesystem::path file(name);
      if (name.empty() || file.is_absolute() || name.find('\0') != name.npos)
        fail("mtllib must name a relative file");
      if (std::ranges::find(libraries_, name) != libraries_.end()) return;
      libraries_.push_back(name);
      materials_.add_library(folder / file);
    };
    std::error_code unreadable;
    if (all.find(' ') == all.npos || std::filesystem::exists(folder / all, unreadable)) return add(all);
    std::string_view rest = all;
    for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest))
      add(std::string(word));
  }

  // Merges equal corners to vertices.
  void add_mesh(const Part& part) {
    scene::Mesh mesh;
    mesh.name = part.name;
    mesh.material = part.material;
    const auto any = [&](int Corner::*member) {
      return std::ranges::any_of(part.corners, [&](const Corner& c) { return c.*member >= 0; });
    };
    const bool has_uv = any(&Corner::uv), has_normal = any(&Corner::normal);
    std::unordered_map<Corner, std::uint32_t, CornerHash> vertices;
    vertices.reserve(part.corners.size() / 2);
    for (std::size_t i = 0; i < part.corners.size(); i += 3) {
      uvec3 triangle;
      for (std::size_t k = 0; k < 3; ++k) {
        Corner c = part.corners[i + k];
        // A corner without a normal among others that have one gets the face's
        if (has_normal && c.normal < 0) c.normal = face_normal(part, i);
        const auto [entry, is_new] = vertices.try_emplace(c, static_cast<std::uint32_t>(vertices.size()));
        triangle[static_cast<int>(k)] = entry->second;
        if (!is_new) continue;
        mesh.positions.push_back(positions_[c.position]);
        if (has_uv) mesh.uvs[0].push_back(c.uv < 0 ? vec2(0) : uvs_[c.uv]);
        if (has_normal) {
          const vec3 n = normals_[c.normal];
          const float length = glm::length(n);
          mesh.normals.push_back(length > 0 && std::isfinite(length) ? n / length : n);
        }
      }
      mesh.triangles.push_back(triangle);
    }
    const int index = static_cast<int>(scene_.meshes.size());
    scene::Node node;
    node.name = part.name;
    scene::Instance instance;
    instance.mesh = instance.node = index;
    const auto& material = scene_.materials[part.material];
    if (material.emissive()) instance.light_group = material.name;
    scene_.meshes.push_back(std::move(mesh));
    scene_.nodes.push_back(std::move(node));
    scene_.instances.push_back(std::move(instance));
  }

  int face_normal(const Part& part, std::size_t first_corner) {
    std::array<vec3, 3> p;
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] = positions_[part.corners[first_corner + k].position];
    }
    const vec3 n = glm::cross(p[1] - p[0], p[2] - p[0]);
    const float length = glm::length(n);
    normals_.push_back(length > 0 && std::isfinite(length) ? n / length : vec3(0, 1, 0));
    return static_cast<int>(normals_.size()) - 1;
  }

  TextLines lines_;
  std::filesystem::path path_;
  scene::Scene scene_;
  Ignored ignored_;
  MtlImport materials_;
  std::vector<vec3> positions_, normals_;
  std::vector<vec2> uvs_;
  std::string group_, material_;
  std::vector<Part> parts_;
  std::map<std::pair<std::string, std::string>, std::size_t> part_of_;
  Part* part_ = nullptr;  // of group_ and material_; null after either changed
  std::vector<std::string> libraries_;
  std::uint64_t triangle_count_ = 0, smoothing_groups_ = 0;
  std::uint64_t ear_clipping_work_ = 200'000'000;
  std::vector<Corner> corners_;  // of the face being read
  std::vector<vec3> polygon_;
  std::vector<uvec3> triangles_;
};

}  // namespace

scene::Scene load_obj(std::string_view text, const std::filesystem::path& path) {
  return ObjReader(text, path).read();
}

}  // namespace ssphh::scene_io
