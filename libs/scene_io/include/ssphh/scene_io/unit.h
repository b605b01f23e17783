#pragma once
/// The unit of length of a scene file, where that is no metre (docs/scenes.md#units).

#include <string>

#include <ssphh/scene/scene.h>

namespace ssphh::scene_io {

/// What is wrong with a unit, "" where nothing is: mm, cm, m, inch, auto, or metres per unit as a number
/// above 0.
std::string unit_problem(const std::string& unit);

/// Metres per unit. "auto" guesses, and says by a warning what it took `where` for and how to overrule that.
/// Throws Error(where, unit_problem).
float metres_per_unit(const std::string& unit, const scene::Scene& scene, const std::string& where);

/// Metres per unit that suit the size of a place for people: 0.001 or 0.01 where a scene is more than 100
/// units wide and width and height are much more like those of rooms and houses in that unit, else 1. Of
/// every axis the outermost 1 % of vertices on either side do not count, so that ground planes and
/// skies do not.
float guess_unit(const scene::Scene& scene);

/// Makes metres of a file's units: a node above all others scales by `unit` [m] after it has moved `origin`,
/// a point in the file's unit, to the world's. Ranges of lights and heights of orthographic views are lengths
/// outside of nodes and scale likewise; radii of spheres and SPHLs are metres in every file, and intensities
/// are candela, lux and radiance, whatever the unit of length.
void set_unit(scene::Scene& scene, float unit, const vec3& origin = vec3(0));

}  // namespace ssphh::scene_io
