// A program as an engine would write it; what the file brings along leaves no macros of vectors behind.
#define SSPHH_REGISTER t3
#include "ssphh_lookup.hlsl"
#if defined(vec3) || defined(uintBitsToFloat)
#error ssphh_lookup.hlsl leaves its macros behind
#endif

RWStructuredBuffer<float3> results : register(u0);

[numthreads(64, 1, 1)] void main(uint3 id : SV_DispatchThreadID) {
  float3 position = float3(id), normal = float3(0, 1, 0);
  float3 still = ssphh_irradiance(position, normal), open = ssphh_irradiance_open(position, normal);
  results[id.x] = still + open + ssphh_irradiance_for(position, normal, normal.yxz, true);
}
