
// --- What is called ---------------------------------------------------------------------------------------------------------------

// Indirect irradiance [W/m2] (and the direct irradiance of baked groups) at a place of the bake's world; never negative. still: it lies on a
// surface that stands where it stood at the bake, whose unit normal is given; else on something that moves, or in the open. Weights and sight
// are by the normal, light is for the shading normal. 0 where position or normal is not finite.
vec3 ssphh_irradiance_for(vec3 position, vec3 normal, vec3 shading_normal, bool still) {
  vec3 irradiance = vec3(0.0, 0.0, 0.0);
  if (any(isnan(position)) || any(isinf(position)) || any(isnan(normal)) || any(isinf(normal))) return irradiance;
  if (still && SSPHH_POINT_COUNT > 0 && ssphh_by_points(position, normal, shading_normal, irradiance)) return irradiance;
  return ssphh_by_probes(position, normal, shading_normal, still);
}

// ssphh_runtime_irradiance with SSPHH_RUNTIME_STILL
vec3 ssphh_irradiance(vec3 position, vec3 normal) { return ssphh_irradiance_for(position, normal, normal, true); }

// The same with SSPHH_RUNTIME_OPEN
vec3 ssphh_irradiance_open(vec3 position, vec3 normal) { return ssphh_irradiance_for(position, normal, normal, false); }
