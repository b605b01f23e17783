
#undef vec2
#undef vec3
#undef vec4
#undef ivec2
#undef ivec3
#undef uvec4
#undef uintBitsToFloat
#undef floatBitsToUint
