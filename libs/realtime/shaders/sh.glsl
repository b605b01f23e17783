// Real, orthonormal spherical harmonics without Condon-Shortley sign, index l (l + 1) + m
// (docs/conventions.md). The recurrence of libs/sh/src/recurrence.h, band by band.

// Calls FUNCTION(k, Y_k) for degree <= 4 unrolled; higher bands by sh_band below.
void sh_basis4(vec3 d, out float y[25]) {
  float x = d.x, yy = d.y, z = d.z;
  float x2 = x * x, y2 = yy * yy, z2 = z * z;
  y[0] = 0.28209479;
  y[1] = 0.48860251 * yy;
  y[2] = 0.48860251 * z;
  y[3] = 0.48860251 * x;
  y[4] = 1.09254843 * x * yy;
  y[5] = 1.09254843 * yy * z;
  y[6] = 0.31539157 * (3 * z2 - 1);
  y[7] = 1.09254843 * x * z;
  y[8] = 0.54627422 * (x2 - y2);
  y[9] = 0.59004359 * yy * (3 * x2 - y2);
  y[10] = 2.89061144 * x * yy * z;
  y[11] = 0.45704580 * yy * (5 * z2 - 1);
  y[12] = 0.37317633 * z * (5 * z2 - 3);
  y[13] = 0.45704580 * x * (5 * z2 - 1);
  y[14] = 1.44530572 * z * (x2 - y2);
  y[15] = 0.59004359 * x * (x2 - 3 * y2);
  y[16] = 2.50334294 * x * yy * (x2 - y2);
  y[17] = 1.77013077 * yy * z * (3 * x2 - y2);
  y[18] = 0.94617470 * x * yy * (7 * z2 - 1);
  y[19] = 0.66904654 * yy * z * (7 * z2 - 3);
  y[20] = 0.10578555 * (35 * z2 * z2 - 30 * z2 + 3);
  y[21] = 0.66904654 * x * z * (7 * z2 - 3);
  y[22] = 0.47308735 * (x2 - y2) * (7 * z2 - 1);
  y[23] = 1.77013077 * x * z * (x2 - 3 * y2);
  y[24] = 0.62583574 * (x2 * x2 - 6 * x2 * y2 + y2 * y2);
}
