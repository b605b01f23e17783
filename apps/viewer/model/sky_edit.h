#pragma once
/// The computed sky of an open scene, as it is shown and changed.

#include "document.h"

namespace ssphh::viewer {

/// What the sky is computed from now; none where the scene's environment is no computed sky.
std::optional<scene::SunSkyParams> shown_sky(const Document& document);

/// An edit: another sky, whose sun lights the scene at once. Preetham's sun stays above the horizon. Throws
/// Error as scene::make_sun_sky.
void change_sky(Document& document, scene::SunSkyParams sky);

/// The same sky with its sun by the clock, at the date and place that it has, else on June 21 at 48.1° north,
/// 11.6° east.
scene::SunSkyParams at_hour(const scene::SunSkyParams& sky, double hour);

}  // namespace ssphh::viewer
