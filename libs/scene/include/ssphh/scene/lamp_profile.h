#pragma once
/// How a lamp's intensity depends on the direction, as photometric laboratories measure it (IES LM-63): a
/// table over two angles about a pole, in the axes of the lamp, which is aimed along its −z.

#include <memory>
#include <string>
#include <vector>

#include <ssphh/core/enum_names.h>
#include <ssphh/core/math.h>

namespace ssphh::scene {

/// Where the poles of the angles are. `c`: the pole is the lamp's aim, −z; the turn begins at +x, toward +y.
/// `b`: the pole is −x, the turn begins at the aim, toward +y (up). `a`: the pole is −y, the turn begins at
/// the aim, toward +x (right).
enum class Photometry { c, b, a };
constexpr auto enum_table(Photometry) {
  using enum Photometry;
  return std::to_array<EnumName<Photometry>>({{c, "C"}, {b, "B"}, {a, "A"}});
}

/// Intensities at pairs of angles, linear between them in both. Angles are in degrees, as files have them, so
/// that writing and reading change no bit.
struct PhotometricTable {
  Photometry type = Photometry::c;
  std::vector<float> polar;    ///< from the pole, rising within 0..180; beyond its ends nothing shines
  std::vector<float> turn;     ///< about the pole, rising within −180..360; one: alike all around
  std::vector<float> candela;  ///< [turn][polar], not negative, above 0 somewhere

  friend bool operator==(const PhotometricTable&, const PhotometricTable&) = default;
};

/// The table of a lamp; lamps share it, and nobody changes it.
struct LampProfile {
  std::string name;  ///< of the file
  std::shared_ptr<const PhotometricTable> table;

  bool empty() const { return !table; }
  friend bool operator==(const LampProfile& a, const LampProfile& b) {
    return a.name == b.name && (a.table == b.table || (a.table && b.table && *a.table == *b.table));
  }
};

inline constexpr std::size_t max_profile_values = std::size_t{1} << 18;

/// Throws Error with `where` as its place for angles that do not rise or are out of bounds, another number of
/// intensities than angles ask for, more than max_profile_values, and ones that are negative, not finite or
/// all 0.
void check_profile(const PhotometricTable& table, const std::string& where);

/// Columns: where the turn begins, a quarter turn on, and the pole, in the axes of the lamp.
mat3 photometric_axes(Photometry type);

/// The intensity [cd] into a unit direction in the photometric axes.
float eval_candela(const PhotometricTable& table, const vec3& direction);

/// The largest intensity of the table [cd].
float greatest_candela(const PhotometricTable& table);

/// The mean over all directions [cd]: 1/4π of the flux.
float mean_candela(const PhotometricTable& table);

}  // namespace ssphh::scene
