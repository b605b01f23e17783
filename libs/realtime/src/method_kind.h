#pragma once

namespace ssphh::realtime {

/// Of a method's light: variants of method.frag.
enum class MethodKind : int { cones, virtual_lights };
inline constexpr int method_kinds = 2;

}  // namespace ssphh::realtime
