// Virtual lights as the method vpl sums them up (libs/methods/vpl/README.md), with shadow maps for rays.

// Mirrors GpuVirtualLight in method_types.h.
struct VirtualLight {
  vec4 place;   // w: radius of a spherical one
  vec4 normal;
  vec4 power;   // over pi
};
layout(std430, binding = BINDING_VIRTUAL_LIGHTS) readonly buffer VirtualLights { VirtualLight virtual_lights[]; };
layout(binding = UNIT_VIRTUAL_LIGHT_MAPS) uniform sampler2DArray virtual_light_maps;
uniform ivec4 lights_drawn;   // first and end of this pass
uniform ivec4 map_layout;     // texels of a face, log2 of tiles in a row
uniform float map_near;
uniform int spheres;
uniform float most_transfer;  // of points

// What light from a direction counts for: its cosine, or a lobe (n + 1)/2pi cos^n around an axis.
struct Receiver {
  vec3 position, normal, axis;
  float exponent;  // below 0: cosine
};
float response(Receiver at, vec3 wi) {
  float cosine = dot(at.normal, wi);
  if (at.exponent < 0) return max(cosine, 0.0);
  float lobe = dot(at.axis, wi);
  return cosine > 0 && lobe > 0 ? (at.exponent + 1) / (2 * PI) * pow(lobe, at.exponent) : 0;
}

// Mean over directions to the sphere of `light`; no rings: none.
float sphere_transfer(Receiver at, VirtualLight light, vec3 way, float distance2, int rings) {
  float radius = light.place.w;
  bool hidden = dot(at.normal, way) < -radius || dot(light.normal.xyz, way) > radius;
  float sine2 = min(radius * radius / max(distance2, 1e-20), 1.0);
  float one_minus = sine2 / (1 + sqrt(1 - sine2));
  mat3 basis = basis_around(distance2 > 0 ? way * inversesqrt(distance2) : at.normal);
  float sum = 0;
  for (int i = 0; i < rings; ++i) {
    float x = (float(i) + 0.5) / float(rings) * one_minus, r = sqrt(x * (2 - x));
    for (int k = 0; k < SPHERE_SPOKES; ++k) {
      float turn = 2 * PI * (float(k) + 0.5 * float(i & 1)) / float(SPHERE_SPOKES);
      vec3 wi = basis * vec3(r * cos(turn), r * sin(turn), 1 - x);
      sum += response(at, wi) * max(-dot(light.normal.xyz, wi), 0.0);
    }
  }
  return hidden ? 0 : sum / float(rings * SPHERE_SPOKES) * 2 * one_minus / (radius * radius);
}

// Irradiance per unit of power over pi; of a lobe, the radiance that it reflects.
float transfer(Receiver at, VirtualLight light) {
  vec3 way = light.place.xyz - at.position;
  float distance2 = dot(way, way);
  vec3 wi = way * inversesqrt(max(distance2, 1e-30));
  float open = response(at, wi) * max(-dot(light.normal.xyz, wi), 0.0) / max(distance2, 1e-30);
  if (spheres == 0) return min(open, most_transfer);
  bool near = distance2 < SPHERE_FAR2 * light.place.w * light.place.w;
  // Software renderers run both sides of every branch but leave loops early
  float spread = sphere_transfer(at, light, way, distance2, near ? SPHERE_RINGS : 0);
  return near ? spread : open;
}

void look_up(Surface s, vec3 mirror, float roughness, out vec3 irradiance, out vec3 glossy) {
  irradiance = glossy = vec3(0);
  Receiver diffuse = Receiver(s.position, s.normal, vec3(0), -1);
#ifdef FULL_BSDF
  float alpha = max(roughness * roughness, 1e-3);
  Receiver lobe = Receiver(s.position, s.normal, mirror, clamp(2 / (alpha * alpha) - 2, 1.0, SHARPEST_LOBE));
  float least = spheres != 0 ? -1 : pow(LEAST_OF_LOBE, 1 / lobe.exponent);
#endif
  for (int i = lights_drawn.x; i < lights_drawn.y; ++i) {
    VirtualLight light = virtual_lights[i];
    vec3 way = light.place.xyz - s.position;
    float to_diffuse = transfer(diffuse, light), to_lobe = 0;
#ifdef FULL_BSDF
    to_lobe = dot(way, mirror) >= least * length(way) ? transfer(lobe, light) : 0;
#endif
    // In front of both surfaces, or a ray would meet one of them; lights stand a little above theirs, of which no
    // map holds what is behind
    bool reached = dot(way, s.geometric_normal) > 0 && dot(way, light.normal.xyz) < 0.5 * map_near &&
                   to_diffuse + to_lobe > 0;
    if (!reached) continue;
    float visible = cube_visibility(virtual_light_maps, map_layout.x, map_layout.y, map_near, i, light.place.xyz,
                                    s.position, s.geometric_normal);
    irradiance += visible * to_diffuse * light.power.rgb;
    glossy += visible * to_lobe * light.power.rgb;
  }
}
