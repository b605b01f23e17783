#pragma once
/// All programs of the renderer. Variants are compiled when first wanted, for there are many and a scene
/// needs few.

#include <array>
#include <optional>

#include <ssphh/gi/lookup.h>
#include <ssphh/gl/program.h>

#include "gpu_types.h"
#include "method_kind.h"

namespace ssphh::realtime {

/// How indirect.frag finds light.
enum class IndirectLookup : int { light, distance, trilinear, mls, fitted };
inline constexpr int indirect_lookups = 5;
/// What it gives: radiance, images for apply.frag, or a view of the choice.
enum class IndirectOutput : int { radiance, images, chosen };

class Shaders {
 public:
  explicit Shaders(const gl::ShaderFiles& files) : files_(&files) {}

  /// A bit for each texture that materials may have.
  static constexpr const char* texture_names[] = {"BASE_TEXTURE", "ROUGH_TEXTURE", "EMISSION_TEXTURE",
                                                  "NORMAL_TEXTURE"};
  gl::Program& geometry(int textures);
  gl::Program& shadow(bool alpha);
  /// Light of one emitter on surfaces that are Lambertian or not; or the share that arrives.
  gl::Program& direct(EmitterKind kind, bool full, bool shadow_view);
  gl::Program& indirect(IndirectLookup lookup, bool full, IndirectOutput output);
  gl::Program& apply(bool full);
  /// Light of a method that keeps none in SPHLs; `images`: for apply.frag.
  gl::Program& method(MethodKind kind, bool full, bool images);
  gl::Program& occlusion() { return get(occlusion_, fullscreen, "occlusion.frag"); }
  /// An emitter that is no surface, as the eye sees it.
  gl::Program& seen(EmitterKind kind);
  gl::Program& view() { return get(view_, fullscreen, "view.frag"); }
  gl::Program& resolve() { return get(resolve_, fullscreen, "resolve.frag"); }
  gl::Program& display() { return get(display_, fullscreen, "display.frag"); }

  /// Compiles whatever is not yet; what compilers said beside errors.
  std::string compile_all();

 private:
  using Slot = std::optional<gl::Program>;
  static constexpr const char* fullscreen = "fullscreen.vert";
  gl::Program& get(Slot& slot, const char* vertex, const char* fragment, const std::string& defines = {});

  const gl::ShaderFiles* files_;
  std::string warnings_;
  Slot geometry_[16], shadow_[2], direct_[emitter_kinds][2][2], indirect_[indirect_lookups][2][3], apply_[2],
      occlusion_, method_[method_kinds][2][2], seen_[emitter_kinds], view_, resolve_, display_;
};

}  // namespace ssphh::realtime
