#pragma once
/// Programs that travel with exported light, src/scripts/ word by word.

#include <string_view>

namespace ssphh::probe_export {

extern const std::string_view unity_script, blender_script;

}  // namespace ssphh::probe_export
