/// The binary interface that programs built before rely on: what changes here does not compile, and asks for
/// another SOVERSION of libssphh_runtime.so. Its names stand in abi.txt (scripts/check-runtime).

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <ssphh/runtime/runtime.h>

namespace ssphh::test {
namespace {

using AbiResult = ssphh_runtime_result;

template <auto function, class Type>
constexpr bool is_still = std::is_same_v<decltype(function), Type*>;

static_assert(is_still<ssphh_runtime_message, const char*(AbiResult)>);
static_assert(is_still<ssphh_runtime_size_needed, AbiResult(const void*, std::size_t, std::size_t*)>);
static_assert(
    is_still<ssphh_runtime_open, AbiResult(const void*, std::size_t, void*, std::size_t, ssphh_runtime**)>);
static_assert(is_still<ssphh_runtime_describe, AbiResult(const ssphh_runtime*, ssphh_runtime_info*)>);
static_assert(is_still<ssphh_runtime_describe_group,
                       AbiResult(const ssphh_runtime*, std::uint32_t, ssphh_runtime_group*)>);
static_assert(
    is_still<ssphh_runtime_set_group_scale, AbiResult(ssphh_runtime*, std::uint32_t, const float*)>);
static_assert(is_still<ssphh_runtime_swap_light, AbiResult(ssphh_runtime*, const void*, std::size_t)>);
static_assert(is_still<ssphh_runtime_irradiance,
                       AbiResult(const ssphh_runtime*, unsigned, const float*, const float*, float*)>);
static_assert(
    is_still<ssphh_runtime_irradiance_batch,
             AbiResult(const ssphh_runtime*, unsigned, const ssphh_runtime_place*, std::size_t, float*)>);

static_assert(sizeof(AbiResult) == 4);
static_assert(SSPHH_RUNTIME_OK == 0 && SSPHH_RUNTIME_BAD_ARGUMENT == 1 && SSPHH_RUNTIME_BAD_MEMORY == 2 &&
              SSPHH_RUNTIME_NOT_COOKED == 3 && SSPHH_RUNTIME_BAD_VERSION == 4 && SSPHH_RUNTIME_CUT_OFF == 5 &&
              SSPHH_RUNTIME_DAMAGED == 6 && SSPHH_RUNTIME_INVALID == 7 && SSPHH_RUNTIME_OTHER_GEOMETRY == 8 &&
              SSPHH_RUNTIME_OTHER_GROUPS == 9);
static_assert(SSPHH_RUNTIME_STILL == 0 && SSPHH_RUNTIME_OPEN == 1);

static_assert(sizeof(ssphh_runtime_info) == 56 && offsetof(ssphh_runtime_info, groups) == 0 &&
              offsetof(ssphh_runtime_info, probes) == 4 && offsetof(ssphh_runtime_info, points) == 8 &&
              offsetof(ssphh_runtime_info, has_sight) == 12 && offsetof(ssphh_runtime_info, time) == 16 &&
              offsetof(ssphh_runtime_info, geometry) == 24 && offsetof(ssphh_runtime_info, scene) == 32 &&
              offsetof(ssphh_runtime_info, light_bytes) == 48);
static_assert(sizeof(ssphh_runtime_group) == 24 && offsetof(ssphh_runtime_group, name) == 0 &&
              offsetof(ssphh_runtime_group, scale) == 8 && offsetof(ssphh_runtime_group, baked) == 20);
static_assert(sizeof(ssphh_runtime_place) == 24 && offsetof(ssphh_runtime_place, position) == 0 &&
              offsetof(ssphh_runtime_place, normal) == 12);

}  // namespace
}  // namespace ssphh::test
