#pragma once
/// The common denominator of renderers' materials.

#include <ssphh/scene/scene.h>

namespace ssphh::scene {

/// The scene with every surface Lambertian: the base colour, its texture and vertex colours are the albedo,
/// of metals too. Specular lobes, diffuse roughness and normal maps are gone; coverage, emission and glass,
/// which reflects nothing then, stay, and unlit surfaces stay unlit. Meshes without a material get one.
Scene lambertian(Scene scene);

}  // namespace ssphh::scene
