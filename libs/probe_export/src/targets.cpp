#include <algorithm>
#include <array>

#include <ssphh/core/enum_names.h>
#include <ssphh/image/half.h>
#include <ssphh/probe_export/target.h>

#include "writers.h"

namespace ssphh::probe_export {
namespace {

/// Of engines that light an object by nine colours.
constexpr std::string_view object_carries =
    "a grid of irradiance of degree 2, resampled by this project's lookup, cells laid along walls";
constexpr std::string_view object_loses =
    "how light changes within an object, whose light is that at one place; bands above 2, fitted weights, "
    "surface records; the engine hides nothing itself";

constexpr std::array table = {
    Target{"csv", "one line per probe, for scripts and importers of one's own",
           "every probe: name, place, radius and the radiance it holds, all bands, summed over groups",
           "edges, fitted weights, surface records", ".csv", sh::max_degree, false, true, write_csv},
    Target{"gltf", "glTF with the own extension SSPHH_light_probes: a GLB file of a node for each probe",
           "every probe: name, place, radius and the radiance it holds, all bands, summed over groups",
           "edges, fitted weights, surface records", ".glb", sh::max_degree, false, true, write_gltf},
    Target{"blender", "a script that makes empties with the light as properties, and balls that show it",
           "every probe: name, place, radius and the radiance it holds, all bands, summed over groups",
           "edges, fitted weights, surface records; Blender's renderers take light from no probe", ".py",
           sh::max_degree, false, true, write_blender},
    Target{"three", "three.js LightProbeGridWebGL: a JSON header and its texture as half floats",
           "a grid of radiance of degree 2, resampled by this project's lookup, cells laid along walls",
           "bands above 2, fitted weights, surface records; the engine hides nothing itself", ".json", 2,
           true, false, write_three},
    Target{"godot", "Godot 4 LightmapGIData.probe_data: a text resource",
           "every probe's radiance of degree 2, tetrahedra between the probes and the planes that find them",
           "bands above 2, fitted weights, surface records; the engine hides nothing itself", ".tres", 2,
           false, false, write_godot},
    Target{
        "unity", "Unity light probes (SphericalHarmonicsL2): a JSON file and the editor script that reads it",
        "every probe's radiance of degree 2, at places of a LightProbeGroup",
        "bands above 2, fitted weights, surface records, tetrahedra: Unity makes its own; the engine hides "
        "nothing itself",
        ".json", 2, false, false, write_unity},
    Target{"bevy", "Bevy IrradianceVolume: ambient cubes as half floats, and a JSON file with its place",
           "a grid of irradiance along six axes, each asked for before the surface there that faces it",
           "all between the axes, fitted weights, surface records; the engine hides nothing itself",
           ".vxgi.ktx2", 2, true, false, write_bevy},
    Target{"babylon",
           "Babylon.js SphericalHarmonics of moving objects: a JSON header and a grid of 32-bit floats",
           object_carries, object_loses, ".json", 2, true, false, write_babylon},
    Target{
        "playcanvas",
        "PlayCanvas StandardMaterial.ambientSH of moving objects: a JSON header and a grid of 32-bit floats",
        object_carries, object_loses, ".json", 2, true, false, write_playcanvas},
};

}  // namespace

std::span<const Target> targets() {
  return table;
}

const Target& find_target(std::string_view name) {
  std::vector<std::string> known;
  for (const Target& target : table) {
    if (target.name == name) return target;
    known.emplace_back(target.name);
  }
  throw Error("export target", none_of(name, known));
}

std::vector<std::byte> bytes_of(std::string_view text) {
  const auto* begin = reinterpret_cast<const std::byte*>(text.data());
  return {begin, begin + text.size()};
}

json::Value json_triple(const vec3& v) {
  return json::Value::array({v.x, v.y, v.z});
}

void write_half(ByteWriter& out, float value, const char* what) {
  out.value(image::to_half(value, what));
}

std::vector<sh::RadianceSh> written_light(const ExportSource& source) {
  probes::LookupParams params;
  params.light = source.light;
  return probes::surface_light(source.set, params);
}

LightGrid make_grid(const ExportSource& source, const Control& control) {
  const FreeLight light(source.set, source.scene, source.light);
  const GridShape shape = source.shape ? *source.shape : fit_grid(source.set, light, source.grid);
  return resample(source.set, light, source.scene, shape, control);
}

}  // namespace ssphh::probe_export
