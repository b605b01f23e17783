#include "commands/sh_file.h"

#include <cmath>
#include <iostream>

#include <fmt/format.h>

#include <ssphh/core/file.h>
#include <ssphh/core/json_cursor.h>
#include <ssphh/core/math.h>

namespace ssphh::app {

namespace {

// A probe is far smaller; this only stops a wrong file from filling memory.
constexpr std::uint64_t coefficient_file_limit = std::uint64_t{16} << 20;

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
  const json::Cursor root(document, where);
  if (!root.is_object() || !root.has("degree") || !root.has("coefficients"))
    root.fail("holds no coefficients",
              "expected {\"degree\": N, \"coefficients\": [[r, g, b], …]} as `ssphh sh project` prints it");
  // Mixing conventions up is a factor of π or a sign that nobody sees.
  if (const auto named = root.find("convention"); named && named->value() != json::Value(name_of(convention)))
    named->fail(fmt::format("is {}, not \"{}\"", json::print(named->value()), name_of(convention)),
                "`ssphh sh convert --from CONVENTION --to ssphh` brings it back");
  const std::int64_t degree = root["degree"].integer(0, sh::convention_max_degree(convention));
  const auto count = static_cast<std::size_t>(sh::coefficient_count(static_cast<int>(degree)));
  std::vector<vec3> values;
  for (const json::Cursor& row : json::elements(root["coefficients"], count, count))
    values.push_back(row.vector3());
  return values;
}

sh::RadianceSh read_radiance_sh(const std::string& path) {
  return sh::from_convention(read_sh_values(path, sh::Convention::ssphh), sh::Convention::ssphh);
}

}  // namespace ssphh::app
