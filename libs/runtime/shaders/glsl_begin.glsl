// Light of a cooked file in GLSL: made from ssphh's libs/runtime/shaders, version @PROJECT_VERSION@; cooked files of version 3
// (docs/cooked-files.md, "In shaders"). For #version 430 and above, 310 es, and Vulkan.
//
//   #define SSPHH_BINDING 3                        the file, as it lies on the disk, in a storage buffer; SSPHH_SET, too, under Vulkan
//   #include "ssphh_lookup.glsl"                   or paste it
//   vec3 E = ssphh_irradiance(position, normal);   what ssphh_runtime_irradiance gives
//
// Or define SSPHH_TEXEL(i), a uvec4 of the file's bytes 16 i to 16 i + 15, where your engine binds memory in a way of its own.
#ifndef SSPHH_TEXEL
#ifndef SSPHH_BINDING
#define SSPHH_BINDING 0
#endif
#ifdef VULKAN
#ifndef SSPHH_SET
#define SSPHH_SET 0
#endif
layout(std430, set = SSPHH_SET, binding = SSPHH_BINDING) readonly buffer SsphhFile { uvec4 ssphh_file[]; };
#else
layout(std430, binding = SSPHH_BINDING) readonly buffer SsphhFile { uvec4 ssphh_file[]; };
#endif
#define SSPHH_TEXEL(i) ssphh_file[i]
#endif
