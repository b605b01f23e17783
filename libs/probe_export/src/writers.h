#pragma once

#include <ssphh/core/json.h>
#include <ssphh/probe_export/target.h>

namespace ssphh::probe_export {

Exported write_babylon(const ExportSource& source, const std::string& name, const Control& control);
Exported write_blender(const ExportSource& source, const std::string& name, const Control& control);
Exported write_csv(const ExportSource& source, const std::string& name, const Control& control);
Exported write_bevy(const ExportSource& source, const std::string& name, const Control& control);
Exported write_gltf(const ExportSource& source, const std::string& name, const Control& control);
Exported write_godot(const ExportSource& source, const std::string& name, const Control& control);
Exported write_playcanvas(const ExportSource& source, const std::string& name, const Control& control);
Exported write_three(const ExportSource& source, const std::string& name, const Control& control);
Exported write_unity(const ExportSource& source, const std::string& name, const Control& control);

std::vector<std::byte> bytes_of(std::string_view text);
json::Value json_triple(const vec3& v);

/// The light of each probe that is to be written, of the set's degree.
std::vector<sh::RadianceSh> written_light(const ExportSource& source);

/// The set's light on the grid that its parameters ask for.
LightGrid make_grid(const ExportSource& source, const Control& control);

}  // namespace ssphh::probe_export
