
// --- The file: a header of 376 bytes, then sections --------------------------------------------------------------------------

uint ssphh_header_word(int byte) {
  uvec4 words = SSPHH_TEXEL(byte >> 4);
  return words[(byte >> 2) & 3];
}
int ssphh_header(int byte) { return int(ssphh_header_word(byte)); }
float ssphh_header_float(int byte) { return uintBitsToFloat(ssphh_header_word(byte)); }
ivec3 ssphh_header_counts(int byte) { return ivec3(ssphh_header(byte), ssphh_header(byte + 4), ssphh_header(byte + 8)); }
vec4 ssphh_header_grid(int byte) {
  return vec4(ssphh_header_float(byte), ssphh_header_float(byte + 4), ssphh_header_float(byte + 8), ssphh_header_float(byte + 12));
}
// First texel of a section, which begins at a multiple of 64 bytes; below 64 GiB
int ssphh_section(int which) { return int((ssphh_header_word(200 + 16 * which) >> 4) | (ssphh_header_word(204 + 16 * which) << 28)); }

#define SSPHH_GROUP_COUNT ssphh_header(56)
#define SSPHH_PROBE_COUNT ssphh_header(64)
#define SSPHH_DEGREE ssphh_header(68)
#define SSPHH_PROBE_TEXELS (ssphh_header(72) >> 2)
#define SSPHH_SIGHT_SIZE ssphh_header(76)
#define SSPHH_LIST_LENGTH ssphh_header(80)
#define SSPHH_SPACING ssphh_header_float(84)
#define SSPHH_PROBE_GRID ssphh_header_grid(88)
#define SSPHH_PROBE_CELL_COUNTS ssphh_header_counts(104)
#define SSPHH_POINT_COUNT ssphh_header(116)
#define SSPHH_POINT_TEXELS (ssphh_header(120) >> 2)
#define SSPHH_NEAR_GRID ssphh_header_grid(136)
#define SSPHH_NEAR_CELLS ssphh_header_counts(152)
#define SSPHH_FAR_GRID ssphh_header_grid(168)
#define SSPHH_FAR_CELLS ssphh_header_counts(184)
#define SSPHH_FAR_BRICK ssphh_header(196)
#define SSPHH_GROUPS ssphh_section(0)
#define SSPHH_PROBES ssphh_section(2)
#define SSPHH_PROBE_CELLS ssphh_section(3)
#define SSPHH_SIGHT ssphh_section(4)
#define SSPHH_BRICKS ssphh_section(5)
#define SSPHH_CELLS ssphh_section(6)
#define SSPHH_ENTRIES ssphh_section(7)
#define SSPHH_MASKS ssphh_section(8)
#define SSPHH_POINTS ssphh_section(9)
#define SSPHH_LIGHT ssphh_section(10)

vec3 ssphh_scale(int group) {
  uvec4 a = SSPHH_TEXEL(SSPHH_GROUPS + 2 * group), b = SSPHH_TEXEL(SSPHH_GROUPS + 2 * group + 1);
  return vec3(uintBitsToFloat(a.z), uintBitsToFloat(a.w), uintBitsToFloat(b.x));
}
int ssphh_group_texels() { return SSPHH_PROBE_COUNT * 3 * SSPHH_PROBE_TEXELS + SSPHH_POINT_COUNT * SSPHH_POINT_TEXELS; }

// Texel of a probe's light, three times SSPHH_PROBE_TEXELS for red, green, blue: of all groups at their scales
vec4 ssphh_probe_light(int probe, int colour, int k) {
  int at = SSPHH_LIGHT + (probe * 3 + colour) * SSPHH_PROBE_TEXELS + k, groups = SSPHH_GROUP_COUNT, group_texels = ssphh_group_texels();
  vec4 sum = vec4(0.0, 0.0, 0.0, 0.0);
  for (int g = 0; g < groups; ++g) {
    vec3 scale = ssphh_scale(g);
    float s = colour == 0 ? scale.x : colour == 1 ? scale.y : scale.z;
    if (s != 0.0) sum += s * uintBitsToFloat(SSPHH_TEXEL(at + g * group_texels));
  }
  return sum;
}

// Texel k of a point's light, whose numbers are red, green, blue in turn
vec4 ssphh_point_light(int point_index, int k) {
  int at = SSPHH_LIGHT + SSPHH_PROBE_COUNT * 3 * SSPHH_PROBE_TEXELS + point_index * SSPHH_POINT_TEXELS + k;
  int groups = SSPHH_GROUP_COUNT, group_texels = ssphh_group_texels(), first = k % 3;
  vec4 sum = vec4(0.0, 0.0, 0.0, 0.0);
  for (int g = 0; g < groups; ++g) {
    vec3 s = ssphh_scale(g);
    vec4 scale = first == 0 ? s.xyzx : first == 1 ? s.yzxy : s.zxyz;
    if (s.x != 0.0 || s.y != 0.0 || s.z != 0.0) sum += scale * uintBitsToFloat(SSPHH_TEXEL(at + g * group_texels));
  }
  return sum;
}
