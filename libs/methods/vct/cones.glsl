// Cones through voxels, step by step as methods::vct::ConeLight traces them (libs/methods/vct/README.md). Places are in voxels
// of level 0, 0 at the grid's corner.

// Mirrors GpuConeBlock in method_types.h.
layout(std140, binding = BINDING_CONE_BLOCK) uniform ConeBlock {
  vec4 grid;    // corner of the grid; w: edge of a voxel
  vec4 march;   // offset, opacity, step, radiance that 1 in the volume stands for
  ivec4 counts; // cones, coarsest level
  vec4 part;    // texels of a side's part in the volume
  vec4 texel;   // 1 / texels of the volume
  vec4 cells[VOXEL_LEVELS];
  vec4 first[VOXEL_LEVELS];
  vec4 lobe_cosines[LOBE_STEPS / 4 + 1];
} cones;
layout(std430, binding = BINDING_CONES) readonly buffer Cones { vec4 hemisphere[]; };
layout(binding = UNIT_VOXELS) uniform sampler3D voxels;  // VolumeLayout

// Sides that face a beam: weights, and where their parts stand along y.
struct Facing { vec3 weight, part; };

// Opacity, and opacity times radiance, per unit of length.
vec4 read_level(int level, vec3 place, Facing facing) {
  float scale = exp2(float(-level));
  // Beyond the border's middle there is nothing
  vec3 at = clamp(place * scale, vec3(-0.5), cones.cells[level].xyz + 0.5) + cones.first[level].xyz;
  vec4 sum = facing.weight.x * textureLod(voxels, (at + vec3(0, facing.part.x, 0)) * cones.texel.xyz, 0);
  sum += facing.weight.y * textureLod(voxels, (at + vec3(cones.part.x, facing.part.y, 0)) * cones.texel.xyz, 0);
  sum += facing.weight.z * textureLod(voxels, (at + vec3(2 * cones.part.x, facing.part.z, 0)) * cones.texel.xyz, 0);
  return scale * sum;
}

// Farther than `reach` from the grid, and on the way out.
bool gone(vec3 p, vec3 direction, vec3 size, float reach) {
  bvec3 above = greaterThan(p, size + reach), below = lessThan(p, vec3(-reach));
  bvec3 up = greaterThanEqual(direction, vec3(0)), down = lessThanEqual(direction, vec3(0));
  return above.x && up.x || above.y && up.y || above.z && up.z || below.x && down.x || below.y && down.y ||
         below.z && down.z;
}

vec4 trace_cone(vec3 origin, vec3 direction, float tangent) {
  Facing facing = Facing(abs(direction), cones.part.y * vec3(greaterThan(direction, vec3(0))));
  int top = cones.counts.y;
  float widest = exp2(float(top));
  vec3 size = cones.cells[0].xyz;
  vec4 seen = vec4(0);
  float edge = 1, t = 0;
  bool crossing = false;
  // Lanes that draw no pixel read zeros from buffers on some drivers: a cone without a width ends at once
  float farthest = tangent > 0 ? length(size) + cones.march.x + 4 * widest : 0;
  while (seen.w < 1 && t < farthest) {
    edge = crossing ? edge : clamp(t * tangent, 1.0, widest);
    float way = cones.march.z * edge, level = log2(edge);
    vec3 place = origin + (t + 0.5 * way) * direction;
    if (gone(place, direction, size, 2 * edge)) break;
    int fine = min(int(level), top);
    float share = fine < top ? level - float(fine) : 0;
    vec4 read = read_level(fine, place, facing);
    read = mix(read, read_level(min(fine + 1, top), place, facing), share);
    crossing = read.w > 0;
    vec4 behind = cones.march.y * way * read;
    // As methods::vct::cover
    seen += behind.w > 0 ? min(behind.w, 1 - seen.w) / behind.w * behind : vec4(0);
    t += way;
  }
  return seen;
}

// The grid's normals are exact; a z of 0 must not lose its sign in the G-buffer, for the basis depends on it.
mat3 cone_basis(vec3 n) { return basis_around(abs(n.z) < 5e-5 ? normalize(vec3(n.xy, 0)) : n); }

vec3 gather_hemisphere(vec3 origin, vec3 n) {
  mat3 basis = cone_basis(n);
  vec3 sum = vec3(0);
  for (int i = 0; i < cones.counts.x; ++i)
    sum += trace_cone(origin, basis * hemisphere[i].xyz, hemisphere[i].w).rgb;
  return PI / float(cones.counts.x) * cones.march.w * sum;
}

float lobe_cosine(float roughness) {
  float place = roughness * float(LOBE_STEPS);
  int low = min(int(place), LOBE_STEPS - 1), high = low + 1;
  return mix(cones.lobe_cosines[low >> 2][low & 3], cones.lobe_cosines[high >> 2][high & 3], place - float(low));
}

// Mean over the part of the lobe that is above the surface: methods::vct::cap_cones.
vec3 gather_lobe(vec3 origin, vec3 n, vec3 mirror, float roughness) {
  float cosine = lobe_cosine(roughness);
  int count = cosine >= ONE_CONE_COSINE ? 1 : CAP_CONES;
  float inner = 1 - (1 - cosine) / float(count);  // cosine of a cone
  float tangent = sqrt(1 - inner * inner) / inner;
  float z = 0.5 * (inner + cosine), r = sqrt(1 - z * z);
  mat3 basis = cone_basis(mirror);
  vec3 sum = vec3(0);
  float weight = 0;
  for (int i = 0; i < count; ++i) {
    float angle = 2 * PI * float(i - 1) / float(CAP_CONES - 1);
    vec3 direction = basis * (i == 0 ? vec3(0, 0, 1) : vec3(r * cos(angle), r * sin(angle), z));
    if (dot(direction, n) <= 0) continue;
    sum += trace_cone(origin, direction, tangent).rgb;
    weight += 1;
  }
  return weight > 0 ? cones.march.w / weight * sum : vec3(0);
}

void look_up(Surface s, vec3 mirror, float roughness, out vec3 irradiance, out vec3 glossy) {
  vec3 origin = (s.position - cones.grid.xyz) / cones.grid.w + cones.march.x * s.normal;
  irradiance = gather_hemisphere(origin, s.normal);
#ifdef FULL_BSDF
  glossy = gather_lobe(origin, s.normal, mirror, roughness);
#else
  glossy = vec3(0);
#endif
}
