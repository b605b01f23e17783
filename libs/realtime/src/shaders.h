#pragma once
/// All programs of the renderer. Variants are compiled when first wanted, for there are many and a scene
/// needs few.

#include <optional>

#include <ssphh/gl/program.h>
#include <ssphh/probes/lookup.h>

#include "gpu_types.h"
#include "shader_constants.h"

namespace ssphh::realtime {

/// How indirect.glsl finds light.
enum class IndirectLookup : int { light, distance, trilinear, mls, surface };
inline constexpr int indirect_lookups = 5;
/// What passes of indirect light give: radiance, images of some pixels, radiance of listed pixels (compute
/// shaders), or a view of the choice.
enum class IndirectOutput : int { radiance, images, listed, chosen };
inline constexpr int indirect_outputs = 4;

class Shaders {
 public:
  explicit Shaders(const gl::ShaderFiles& files) : files_(&files) {}

  /// A bit for each texture that materials may have.
  static constexpr const char* texture_names[] = {"BASE_TEXTURE", "ROUGH_TEXTURE", "EMISSION_TEXTURE",
                                                  "NORMAL_TEXTURE"};
  /// `glass`: with the layers of gbuffer.frag; `bent`: of GlassLayer::bent alone.
  gl::Program& geometry(int textures, bool glass, bool bent = false);
  /// What shows the inside of a body between two pieces of a wall.
  gl::Program& mend_cracks() { return get(mend_cracks_, "mend_cracks.frag"); }
  gl::Program& shadow(bool alpha);
  /// An engine's G-buffer as ours.
  gl::Program& take_gbuffer() { return get(take_gbuffer_, "gbuffer_take.frag"); }
  /// What glass leaves of a light on its way.
  gl::Program& glass_shadow();
  /// A level of the bounds of depth, from the map itself or from the level before.
  gl::Program& depth_bounds(bool first);
  /// Light of one emitter on surfaces that are Lambertian or not; or the share that arrives. `glass`: maps
  /// tell what glass leaves of it.
  gl::Program& direct(EmitterKind kind, bool full, bool shadow_view, bool glass);
  /// What surfaces that are not Lambertian mirror of the environment alone.
  gl::Program& mirrored_environment(bool glass);
  gl::Program& indirect(IndirectLookup lookup, bool full, IndirectOutput output);
  /// Whether pixels of images agree, which pixels between may be interpolated, and the light of those.
  gl::Program& agree(bool full);
  gl::Program& mark() { return get(mark_, "mark.frag"); }
  gl::Program& interpolate(bool full);
  /// Light of a method that keeps none in SPHLs.
  gl::Program& method(MethodKind kind, bool full, IndirectOutput output);
  gl::Program& occlusion() { return get(occlusion_, "occlusion.frag"); }
  /// An emitter that is no surface, as the eye sees it.
  gl::Program& seen(EmitterKind kind);
  /// The picture behind glass: dimmed, and spread where a rough sheet is.
  gl::Program& behind_glass(bool spread) {
    return get(behind_glass_[spread], fullscreen, "behind_glass.frag",
               [&] { return std::string(spread ? "#define SPREAD\n" : ""); });
  }
  gl::Program& some_places() { return get(some_places_, "some_places.frag"); }
  gl::Program& view() { return get(view_, "view.frag"); }
  gl::Program& resolve() { return get(resolve_, "resolve.frag"); }
  gl::Program& display() { return get(display_, "display.frag"); }

  /// Compiles whatever is not yet; what compilers said beside errors.
  std::string compile_all();

 private:
  using Slot = std::optional<gl::Program>;
  static constexpr const char* fullscreen = "fullscreen.vert";
  gl::Program& compiled(Slot& slot, gl::Program program);
  template <class Defines>
  gl::Program& get(Slot& slot, const char* vertex, const char* fragment, const Defines& defines) {
    return slot ? *slot
                : compiled(slot, gl::Program(*files_, vertex, fragment, shader_constants() + defines()));
  }
  gl::Program& get(Slot& slot, const char* fragment) {
    return get(slot, fullscreen, fragment, [] { return std::string(); });
  }

  gl::Program& indirect_pass(Slot& slot, const char* file, bool full, IndirectOutput output,
                             const std::string& defines);

  const gl::ShaderFiles* files_;
  std::string warnings_;
  Slot geometry_[16][3], shadow_[2], depth_bounds_[2], glass_shadow_, direct_[emitter_kinds][2][2][2],
      mirrored_environment_[2], indirect_[indirect_lookups][2][indirect_outputs], agree_[2], mark_,
      interpolate_[2], occlusion_, method_[method_kinds][2][indirect_outputs], seen_[emitter_kinds], view_,
      resolve_, display_, take_gbuffer_, some_places_, mend_cracks_, behind_glass_[2];
};

}  // namespace ssphh::realtime
