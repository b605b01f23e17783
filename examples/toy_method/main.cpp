// A program with a method that the library does not have: CMakeLists.txt lists it beside `direct`.

#include <cstdio>

#include <ssphh/methods/method_list.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/trace/transport_scene.h>

using namespace ssphh;

int main() {
  for (const methods::MethodEntry& entry : methods::all_methods())
    std::printf("%-7s %s\n", entry.name, entry.about);

  const scene::Scene scene = scene::make_builtin("cornell");
  const trace::TransportScene source(scene);
  const methods::MethodEntry& entry = methods::find_method("even");
  const std::vector<std::string> settings{"share=0.25"};
  const auto method =
      entry.make({scene, source}, methods::MethodParameters(entry.name, entry.parameters, settings), {});
  scene::LightingState state = rays::lighting_at(source);
  for (const float factor : {1.0f, 0.5f}) {
    state.group_scales.assign(state.group_scales.size(), vec3(factor));
    method->update(state, {});
    const vec3 e = method->light().irradiance({});
    std::printf("lamps at %.1f: indirect irradiance %.3f W/m2\n", static_cast<double>(factor),
                static_cast<double>(e.x));
  }
}
