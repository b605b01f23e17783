#include "commands/sh_file.h"

#include <cmath>
#include <iostream>

#include <fmt/format.h>

#include <ssphh/core/file.h>
#include <ssphh/core/math.h>

namespace ssphh::app {

namespace {

// A probe is far smaller; this only stops a wrong file from filling memory.
constexpr std::uint64_t coefficient_file_limit = std::uint64_t{16} << 20;

// ---- the JSON object of coefficients
// ---------------------------------------------------------------------------

json::Value number(float value) {
  if (!std::isfinite(value))
    throw Error("coefficients", "one is beyond what a float holds, 3.4e38", "scale them down first");
  // The shortest decimal that reads back to the same float.
  return json::parse(fmt::format("{}", value), "number");
}

}  // namespace

json::Value rgb_to_json(const vec3& v) {
  return json::Value::array({number(v.x), number(v.y), number(v.z)});
}

json::Value sh_to_json(std::span<const vec3> coefficients, int degree) {
  json::Value rows = json::Value::array();
  for (const vec3& c : coefficients) rows.push_back(rgb_to_json(c));
  return {{"degree", degree}, {"coefficients", rows}};
}

std::string sh_text(const json::Value& object) {
  std::string text = fmt::format("degree {}", object["degree"].number());
  int l = 0, m = 0;
  for (const json::Value& row : object["coefficients"].elements()) {
    text += fmt::format("\n{:3} {:4}  {:>13.6g} {:>13.6g} {:>13.6g}", l, m, row[0].number(), row[1].number(),
                        row[2].number());
    if (++m > l) ++l, m = -l;
  }
  return text;
}

std::vector<vec3> read_sh_values(const std::string& path, sh::Convention convention) {
  const std::string where = path == "-" ? "stdin" : path;
  std::string text;
  if (path == "-") {
    char buffer[1 << 16];
    while (std::cin.read(buffer, sizeof buffer), std::cin.gcount() > 0) {
      text.append(buffer, static_cast<std::size_t>(std::cin.gcount()));
      if (text.size() > coefficient_file_limit) throw Error(where, "too long for a set of coefficients");
    }
  } else {
    text = read_text_file(path, coefficient_file_limit);
  }

  const std::string hint =
      "expected {\"degree\": N, \"coefficients\": [[r, g, b], …]} as `ssphh sh project` prints it";
  const json::Value document = json::parse(text, where, {.bytes = coefficient_file_limit, .depth = 8});
  if (!document.is_object()) throw Error(where, "is no JSON object", hint);
  const json::Value *degree = document.find("degree"), *rows = document.find("coefficients");
  const std::optional<std::int64_t> n = degree ? degree->integer() : std::nullopt;
  if (!n) throw Error(where, "has no whole number \"degree\"", hint);
  if (!rows || !rows->is_array()) throw Error(where, "has no array \"coefficients\"", hint);
  // Mixing conventions up is a factor of π or a sign that nobody sees.
  const json::Value* named = document.find("convention");
  const std::string expected_name(name_of(convention));
  if (named && *named != json::Value(expected_name)) {
    throw Error(where, fmt::format("is in convention {}, not \"{}\"", json::print(*named), expected_name),
                "`ssphh sh convert --from CONVENTION --to ssphh` brings it back");
  }
  const int limit = sh::convention_max_degree(convention);
  if (*n < 0 || *n > limit) throw Error(where, fmt::format("degree {} is outside 0..{}", *n, limit));
  const auto expected = static_cast<std::size_t>(sh::coefficient_count(static_cast<int>(*n)));
  if (rows->size() != expected) {
    throw Error(where,
                fmt::format("degree {} has {} coefficients, but {} are given", *n, expected, rows->size()));
  }
  std::vector<vec3> values;
  for (const json::Value& row : rows->elements()) {
    const auto place = fmt::format("coefficients[{}]", values.size());
    if (!row.is_array() || row.size() != 3) throw Error(where, place + " is not [r, g, b]", hint);
    vec3 value;
    for (int c = 0; c < 3; ++c) {
      const json::Value& channel = row[static_cast<std::size_t>(c)];
      if (!channel.is_number()) throw Error(where, place + " holds something that is no number", hint);
      value[c] = static_cast<float>(channel.number());
    }
    if (!is_finite(value)) throw Error(where, place + " does not fit a finite single-precision number");
    values.push_back(value);
  }
  return values;
}

sh::RadianceSh read_radiance_sh(const std::string& path) {
  return sh::from_convention(read_sh_values(path, sh::Convention::ssphh), sh::Convention::ssphh);
}

}  // namespace ssphh::app
