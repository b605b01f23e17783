#pragma once
/// The JSON object of coefficients that the `ssphh sh` commands pass on: {"degree": N, "coefficients": [[r,
/// g, b], …]}.

#include <span>
#include <string>
#include <vector>

#include <ssphh/core/json.h>
#include <ssphh/sh/convert.h>

namespace ssphh::app {

/// [r, g, b], each as the shortest decimal that reads back to the same float.
json::Value rgb_to_json(const vec3& rgb);

json::Value sh_to_json(std::span<const vec3> coefficients, int degree);

/// The object as a table of l, m, R, G, B.
std::string sh_text(const json::Value& object);

/// The stored values in a file, or on stdin for "-", of any convention. Throws Error unless it is an object
/// of the form above whose degree the convention has, with as many finite values as the degree asks for. A
/// "convention" that the object names must be the one asked for.
std::vector<vec3> read_sh_values(const std::string& path, sh::Convention convention);

/// Coefficients of radiance in this project's convention.
sh::RadianceSh read_radiance_sh(const std::string& path);

}  // namespace ssphh::app
