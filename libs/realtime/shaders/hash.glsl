// Hash of three integers, 0..1 (Jarzynski and Olano, Hash Functions for GPU Rendering, JCGT 2020: pcg3d).
float hash01(uvec3 v) {
  v = v * 1664525u + 1013904223u;
  v.x += v.y * v.z, v.y += v.z * v.x, v.z += v.x * v.y;
  v ^= v >> 16u;
  v.x += v.y * v.z;
  return float(v.x >> 8) / 16777216.0;
}
