#pragma once
/// How bright a picture is, in stops: for histograms, waveforms and false colours.
///
/// Stops count from middle grey: luminance 0.18 of the picture's white, which is 2^−EV W/(sr m²).

#include <array>
#include <string>

#include <ssphh/image/image.h>
#include <ssphh/image/io.h>

namespace ssphh::viewer {

inline constexpr int farthest_stop = 8;                   ///< that is told apart, darker and brighter
inline constexpr int stop_bands = 2 * farthest_stop + 1;  ///< a stop each, middle grey in the middle one
inline constexpr int bins_per_stop = 4;
inline constexpr std::size_t stop_bins = std::size_t{stop_bands} * bins_per_stop;

/// Of a luminance [W/(sr m²)]; −∞ for 0.
float stops_of(float luminance, float exposure);
/// Luminance [W/(sr m²)] that is so many stops from middle grey.
float luminance_at(float stops, float exposure);

/// Shares of a picture's pixels.
struct StopHistogram {
  /// Of a quarter stop each, those of stop_bands.
  std::array<float, stop_bins> bins{};
  float darker = 0, brighter = 0;  ///< than all bins; black counts as darker
};

/// Of some hundred thousand pixels, spread evenly, or all of a smaller picture.
StopHistogram stop_histogram(const image::Image& radiance, float exposure);

inline constexpr int waveform_columns = 64;

/// Where in a picture which light is: of red, green and blue [W/(sr m²)], shares of the pixels of each of
/// its equally wide columns, the left one first, by their stops. What is darker or brighter than all bins,
/// and NaN, counts in the first or the last one.
struct Waveform {
  using Column = std::array<float, stop_bins>;  ///< of a quarter stop each, as StopHistogram::bins; sum 1
  std::array<std::array<Column, waveform_columns>, 3> channels{};
};

/// Of some hundred thousand pixels in rows that are spread evenly, or all of a smaller picture.
Waveform waveform(const image::Image& radiance, float exposure);
/// Beside each other as a wipe shows two pictures: columns of `left` up to `line`, a share of the width.
Waveform wiped(Waveform left, const Waveform& right, float line);

/// sRGB of a band, from −farthest_stop to farthest_stop: blue is dark, red is bright, middle grey is grey.
/// Beyond them black and white.
std::array<std::uint8_t, 3> color_of_stop(int stop);
/// Each pixel in the colour of its luminance.
image::Rgba8 false_color(const image::Image& radiance, float exposure);

/// "+3", "0", "−2".
std::string stop_text(int stop);

}  // namespace ssphh::viewer
