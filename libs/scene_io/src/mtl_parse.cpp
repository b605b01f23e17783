#include <array>
#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/error.h>

#include "mtl.h"
#include "printable.h"
#include "text_lines.h"

namespace ssphh::scene_io {
namespace {

// One statement of an MTL file.
class Statement {
 public:
  Statement(std::string_view line, const std::string& file, std::size_t number)
      : rest_(line), file_(file), number_(number), keyword_(next_word(rest_)) {}

  std::string_view keyword() const { return keyword_; }
  std::string_view rest() const { return trimmed(rest_); }

  [[noreturn]] void fail(const std::string& problem) const {
    throw Error(fmt::format("{}:{}", file_, number_), fmt::format("{}: {}", keyword_, problem));
  }

  float number() {
    const std::string_view word = next_word(rest_);
    const auto value = parse_float(word);
    if (!value || !std::isfinite(*value))
      fail(fmt::format("\"{}\" is no finite number", printable(word, 40)));
    return *value;
  }

  std::optional<float> optional_number() {
    std::string_view after = rest_;
    const auto value = parse_float(next_word(after));
    if (!value || !std::isfinite(*value)) return std::nullopt;
    rest_ = after;
    return value;
  }

  // "r g b" or one number for all three.
  vec3 color() {
    const float r = number();
    if (rest().empty()) return vec3(r);
    const float g = number();
    return {r, g, number()};
  }

  // [options] file name, which may hold blanks.
  MtlTexture texture() {
    MtlTexture out;
    for (std::string_view after = rest_; rest().starts_with('-'); after = rest_) {
      const std::string_view option = next_word(after);
      rest_ = after;
      if (option == "-o" || option == "-s" || option == "-t") {
        std::array<float, 3> uvw{option == "-s" ? 1.0f : 0.0f, option == "-s" ? 1.0f : 0.0f, 0};
        for (auto& value : uvw) {
          const auto given = optional_number();
          if (!given) break;
          value = *given;
        }
        if (option == "-o") out.offset = {uvw[0], uvw[1]};
        if (option == "-s") out.scale = {uvw[0], uvw[1]};
      } else if (option == "-mm") {
        number();
        number();
      } else if (option == "-bm") {
        out.bump = number();
      } else if (option == "-clamp") {
        out.clamp = next_word(rest_) == "on";
      } else {
        next_word(rest_);  // every other option has one argument
      }
    }
    out.file = rest();
    return out;
  }

 private:
  std::string_view rest_;
  const std::string& file_;
  std::size_t number_;
  std::string_view keyword_;
};

bool parse_color(Statement& s, MtlMaterial& m) {
  const std::string_view k = s.keyword();
  if (k != "Kd" && k != "Ks" && k != "Ke" && k != "Tf") return false;
  if (s.rest().starts_with("spectral") || s.rest().starts_with("xyz")) {
    if (k == "Tf") return false;
    s.fail("only RGB values can be read");
  }
  const vec3 value = s.color();
  if (value.x < 0 || value.y < 0 || value.z < 0) s.fail("must not be negative");
  if (k == "Tf") {
    m.filter = value;
  } else {
    (k == "Kd" ? m.kd : k == "Ks" ? m.ks : m.ke) = value;
  }
  return true;
}

bool parse_scalar(Statement& s, MtlMaterial& m) {
  const std::string_view k = s.keyword();
  if (k == "Ns") {
    m.ns = s.number();
  } else if (k == "Ni") {
    m.ni = s.number();
  } else if (k == "d") {
    if (s.rest().starts_with("-halo")) return false;
    m.dissolve = s.number();
  } else if (k == "Tr") {
    m.transparency = s.number();
  } else if (k == "Pr") {
    m.roughness = s.number();
  } else if (k == "Pm") {
    m.metallic = s.number();
  } else if (k == "illum") {
    m.illum = static_cast<int>(glm::clamp(s.number(), 0.0f, 10.0f));
  } else {
    return false;
  }
  return true;
}

bool parse_texture(Statement& s, MtlMaterial& m) {
  const std::string_view k = s.keyword();
  MtlTexture* const map = k == "map_Kd"   ? &m.map_kd
                          : k == "map_Ke" ? &m.map_ke
                          : k == "map_d"  ? &m.map_d
                          : k == "norm"   ? &m.normal
                                          : nullptr;
  if (map) *map = s.texture();
  return map;
}

}  // namespace

std::vector<MtlMaterial> parse_mtl(std::string_view text, const std::string& file, Ignored& ignored) {
  std::vector<MtlMaterial> materials;
  TextLines lines(text);
  while (lines.next()) {
    Statement statement(lines.line(), file, lines.number());
    if (statement.keyword() == "newmtl") {
      materials.emplace_back().name = printable(statement.rest());
    } else if (materials.empty()) {
      statement.fail("stands before the first newmtl");
    } else if (statement.keyword() == "Ka") {
      continue;  // ambient light has no counterpart
    } else if (!parse_color(statement, materials.back()) && !parse_scalar(statement, materials.back()) &&
               !parse_texture(statement, materials.back())) {
      ignored.add(fmt::format("MTL statement {}", printable(statement.keyword(), 40)));
    }
  }
  return materials;
}

}  // namespace ssphh::scene_io
