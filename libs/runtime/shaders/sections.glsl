
vec4 ssphh_floats(int i) { return uintBitsToFloat(SSPHH_TEXEL(i)); }
uint ssphh_word(int section, int i) {
  uvec4 words = SSPHH_TEXEL(section + (i >> 2));
  return words[i & 3];
}
uint ssphh_short(int section, int i) { return (ssphh_word(section, i >> 1) >> uint(16 * (i & 1))) & 0xffffu; }
int ssphh_bits(uint v) {
  v -= (v >> 1u) & 0x55555555u;
  v = (v & 0x33333333u) + ((v >> 2u) & 0x33333333u);
  return int((((v + (v >> 4u)) & 0x0f0f0f0fu) * 0x01010101u) >> 24u);
}
