#include "shaders.h"

namespace ssphh::realtime {
namespace {

constexpr const char* kind_names[emitter_kinds] = {"POINT",  "SPHL", "SUN",         "DISC",
                                                   "SPHERE", "MESH", "ENVIRONMENT", "LOBE"};

std::string define(const char* name, bool on = true) {
  return on ? std::string("#define ") + name + "\n" : std::string();
}

}  // namespace

gl::Program& Shaders::compiled(Slot& slot, gl::Program program) {
  slot = std::move(program);
  warnings_ += slot->warnings();
  return *slot;
}

gl::Program& Shaders::geometry(int textures, bool glass, bool bent) {
  return get(geometry_[textures][glass + bent], "gbuffer.vert", "gbuffer.frag", [&] {
    std::string defines = define("GLASS", glass) + define("BENT", bent);
    for (int i = 0; i < 4; ++i) defines += define(texture_names[i], (textures >> i & 1) != 0);
    return defines;
  });
}

gl::Program& Shaders::shadow(bool alpha) {
  return get(shadow_[alpha], "shadow.vert", "shadow.frag", [&] { return define("ALPHA", alpha); });
}

gl::Program& Shaders::glass_shadow() {
  return get(glass_shadow_, "shadow.vert", "shadow.frag", [] { return define("ALPHA") + define("GLASS"); });
}

gl::Program& Shaders::depth_bounds(bool first) {
  return get(depth_bounds_[first], fullscreen, "depth_bounds.frag", [&] { return define("FIRST", first); });
}

gl::Program& Shaders::direct(EmitterKind kind, bool full, bool shadow_view, bool glass) {
  const auto k = static_cast<int>(kind);
  return get(direct_[k][full][shadow_view][glass], fullscreen, "direct.frag", [&] {
    return define(kind_names[k]) + define("FULL_BSDF", full) + define("SHADOW_VIEW", shadow_view) +
           define("GLASS", glass);
  });
}

gl::Program& Shaders::mirrored_environment(bool glass) {
  return get(mirrored_environment_[glass], fullscreen, "direct.frag", [&] {
    return define("ENVIRONMENT") + define("FULL_BSDF") + define("MIRRORED") + define("GLASS", glass);
  });
}

gl::Program& Shaders::indirect_pass(Slot& slot, const char* file, bool full, IndirectOutput output,
                                    const std::string& defines) {
  const std::string all = shader_constants() + defines + define("FULL_BSDF", full) +
                          define("TO_IMAGES", output == IndirectOutput::images) +
                          define("LISTED", output == IndirectOutput::listed) +
                          define("CHOSEN_VIEW", output == IndirectOutput::chosen);
  return compiled(slot, output == IndirectOutput::listed ? gl::Program::compute(*files_, file, all)
                                                         : gl::Program(*files_, fullscreen, file, all));
}

gl::Program& Shaders::indirect(IndirectLookup lookup, bool full, IndirectOutput output) {
  Slot& slot = indirect_[static_cast<int>(lookup)][full][static_cast<int>(output)];
  if (slot) return *slot;
  return indirect_pass(
      slot, "indirect.glsl", full, output,
      define("LOOKUP_LIGHT", lookup == IndirectLookup::light) +
          define("TRILINEAR", lookup == IndirectLookup::trilinear) +
          define("MLS", lookup == IndirectLookup::mls || lookup == IndirectLookup::surface) +
          define("FITTED", lookup == IndirectLookup::surface && output != IndirectOutput::chosen));
}

gl::Program& Shaders::agree(bool full) {
  return get(agree_[full], fullscreen, "agree.frag", [&] { return define("FULL_BSDF", full); });
}

gl::Program& Shaders::interpolate(bool full) {
  return get(interpolate_[full], fullscreen, "interpolate.frag", [&] { return define("FULL_BSDF", full); });
}

gl::Program& Shaders::method(MethodKind kind, bool full, IndirectOutput output) {
  Slot& slot = method_[static_cast<int>(kind)][full][static_cast<int>(output)];
  if (slot) return *slot;
  return indirect_pass(slot, "method.glsl", full, output, define("CONES", kind == MethodKind::cones));
}

gl::Program& Shaders::seen(EmitterKind kind) {
  const auto k = static_cast<int>(kind);
  return get(seen_[k], fullscreen, "seen.frag", [&] { return define(kind_names[k]); });
}

std::string Shaders::compile_all() {
  for (int textures = 0; textures < 16; ++textures)
    geometry(textures, false), geometry(textures, true), geometry(textures, true, true);
  occlusion(), mark(), view(), resolve(), display(), glass_shadow(), take_gbuffer(), some_places(),
      mend_cracks();
  for (const bool full : {false, true}) {
    shadow(full), behind_glass(full);
    depth_bounds(full), agree(full), interpolate(full), mirrored_environment(full);
    for (const auto output : {IndirectOutput::radiance, IndirectOutput::images, IndirectOutput::listed}) {
      for (int k = 0; k < method_kinds; ++k) method(static_cast<MethodKind>(k), full, output);
    }
    for (int k = 0; k < emitter_kinds; ++k) {
      for (const bool glass : {false, true}) {
        direct(static_cast<EmitterKind>(k), full, false, glass);
        direct(static_cast<EmitterKind>(k), full, true, glass);
      }
    }
    for (int lookup = 0; lookup < indirect_lookups; ++lookup) {
      for (int output = 0; output < indirect_outputs; ++output)
        indirect(static_cast<IndirectLookup>(lookup), full, static_cast<IndirectOutput>(output));
    }
  }
  for (const auto kind :
       {EmitterKind::disc, EmitterKind::sphere, EmitterKind::mesh, EmitterKind::environment})
    seen(kind);
  return warnings_;
}

}  // namespace ssphh::realtime
