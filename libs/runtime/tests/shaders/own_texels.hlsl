// An engine that keeps the file in a structured buffer of its own.
StructuredBuffer<uint4> rows : register(t7);
#define SSPHH_TEXEL(i) rows[i]
#include "ssphh_lookup.hlsl"

RWStructuredBuffer<float3> results : register(u0);
[numthreads(64, 1, 1)] void main(uint3 id : SV_DispatchThreadID) { results[id.x] = ssphh_irradiance(float3(id), float3(0, 1, 0)); }
