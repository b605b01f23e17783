// Light of a cooked file in HLSL: made from ssphh's libs/runtime/shaders, version @PROJECT_VERSION@; cooked files of version 3
// (docs/cooked-files.md, "In shaders"). For shader model 5 and above.
//
//   #define SSPHH_REGISTER t3                        the file, as it lies on the disk, in a raw buffer
//   #include "ssphh_lookup.hlsl"
//   float3 E = ssphh_irradiance(position, normal);   what ssphh_runtime_irradiance gives
//
// Or define SSPHH_TEXEL(i), a uint4 of the file's bytes 16 i to 16 i + 15, where your engine binds memory in a way of its own.
#ifndef SSPHH_TEXEL
#ifndef SSPHH_REGISTER
#define SSPHH_REGISTER t0
#endif
ByteAddressBuffer ssphh_file : register(SSPHH_REGISTER);
#define SSPHH_TEXEL(i) ssphh_file.Load4(16u * uint(i))
#endif

#define vec2 float2
#define vec3 float3
#define vec4 float4
#define ivec2 int2
#define ivec3 int3
#define ivec4 int4
#define uvec4 uint4
#define uintBitsToFloat asfloat
#define floatBitsToUint asuint
