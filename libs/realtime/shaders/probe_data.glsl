// SPHLs: places, light and which of them stand around a point.
layout(std430, binding = 0) readonly buffer ProbePlaces { vec4 probe_places[]; };
layout(std430, binding = 1) readonly buffer ProbeIrradiance { float probe_irradiance[]; };
layout(std430, binding = 2) readonly buffer ProbeRadiance { float probe_radiance[]; };
layout(std430, binding = 6) readonly buffer ProbeGrid { int probe_grid[]; };
layout(std430, binding = 7) readonly buffer ProbeEmission { float probe_emission[]; };
layout(binding = 7) uniform sampler2DArray probe_maps;
// Factors of bands (x) for a glossy lobe by roughness (y).
layout(binding = 12) uniform sampler2D glossy_bands;

const int MAX_DEGREE = 10;

float probe_visibility(int probe, vec3 x, vec3 n) {
  return cube_visibility(probe_maps, frame.maps.z, frame.map_tiles.z, frame.map_near.z, probe, probe_places[probe].xyz,
                         x, n);
}

// First entry of the list of candidates around x, nearest to the cell's middle first.
int candidates_at(vec3 x) {
  ivec3 cell = ivec3(floor((x - frame.grid_origin.xyz) / frame.grid_origin.w));
  cell = clamp(cell, ivec3(0), frame.grid_size.xyz - 1);
  return ((cell.z * frame.grid_size.y + cell.y) * frame.grid_size.x + cell.x) * frame.counts.z;
}

// Visits Y_lm(d) for l <= degree in the order m = 0, 1, ...; BODY uses k and y.
#define FOR_EACH_HARMONIC(degree, d, BODY)                                        \
  {                                                                               \
    vec2 power_ = vec2(1, 0);                                                     \
    float sectoral_ = 0.28209479177;                                              \
    for (int m_ = 0; m_ <= (degree); ++m_) {                                      \
      float before_ = 0, now_ = sectoral_, scale_before_ = 0;                     \
      for (int l_ = m_; l_ <= (degree); ++l_) {                                   \
        int k = l_ * (l_ + 1) + m_;                                               \
        float y = now_ * power_.x * (m_ > 0 ? 1.41421356237 : 1.0);               \
        int l = l_;                                                               \
        BODY;                                                                     \
        if (m_ > 0) {                                                             \
          k = l_ * (l_ + 1) - m_;                                                 \
          y = now_ * power_.y * 1.41421356237;                                    \
          BODY;                                                                   \
        }                                                                         \
        float n_ = float(l_ + 1), mm_ = float(m_ * m_);                           \
        float a_ = sqrt((4 * n_ * n_ - 1) / (n_ * n_ - mm_));                     \
        float next_ = a_ * ((d).z * now_ - scale_before_ * before_);              \
        scale_before_ = 1 / a_;                                                   \
        before_ = now_;                                                           \
        now_ = next_;                                                             \
      }                                                                           \
      float q_ = float(2 * m_ + 3) / float(2 * m_ + 2);                           \
      sectoral_ *= sqrt(q_);                                                      \
      power_ = vec2((d).x * power_.x - (d).y * power_.y, (d).x * power_.y + (d).y * power_.x); \
    }                                                                             \
  }

// Radiance that a probe with emission sends into the direction d.
vec3 emission_toward(int probe, vec3 d) {
  vec3 sum = vec3(0);
  int base = probe * 3 * (MAX_DEGREE + 1) * (MAX_DEGREE + 1);
  FOR_EACH_HARMONIC(MAX_DEGREE, d, {
    int at = base + 3 * k;
    sum += y * vec3(probe_emission[at], probe_emission[at + 1], probe_emission[at + 2]);
  })
  return sum;
}
