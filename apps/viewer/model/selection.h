#pragma once
/// What of the scene is selected.

#include <ssphh/core/enum_names.h>

namespace ssphh::viewer {

enum class Kind { none, light, sphl, material, object };
/// Names of what can be selected.
inline constexpr auto selectable_kinds = std::to_array<EnumName<Kind>>(
    {{Kind::light, "light"}, {Kind::sphl, "sphl"}, {Kind::material, "material"}, {Kind::object, "object"}});

struct Selection {
  Kind kind = Kind::none;
  int index = -1;        ///< of an object: its node
  int of_material = -1;  ///< of an object: the material where it was clicked

  bool is(Kind k) const { return kind == k && index >= 0; }
  /// Chosen itself, or with an object; −1: none.
  int material() const { return kind == Kind::material ? index : kind == Kind::object ? of_material : -1; }
  friend bool operator==(const Selection&, const Selection&) = default;
};

}  // namespace ssphh::viewer
