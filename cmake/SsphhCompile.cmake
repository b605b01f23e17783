# Compile options shared by every target of this project; not exported to users of the installed package. What is in C is shipped to
# machines that nobody knows: it takes the compiler's own architecture.
if(SSPHH_ARCH)
  set(architecture $<$<COMPILE_LANGUAGE:CXX>:-march=${SSPHH_ARCH}>)
else()
  set(vectors_of_any_width $<$<CXX_COMPILER_ID:GNU,Clang>:-Wno-psabi>)
  set(architecture -ffp-contract=off)  # where others have fused multiply-adds, bits are these, too
endif()
add_library(ssphh_compile_options INTERFACE)
target_compile_options(ssphh_compile_options INTERFACE
  -Wall -Wextra -Wpedantic $<$<COMPILE_LANGUAGE:CXX>:-Wnon-virtual-dtor> $<$<COMPILE_LANGUAGE:CXX>:-Wold-style-cast>
  $<$<COMPILE_LANGUAGE:CXX>:-Woverloaded-virtual> -Werror=return-type $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict> ${vectors_of_any_width}
  -fno-math-errno ${architecture})
if(NOT SSPHH_UNITY)
  target_compile_options(ssphh_compile_options INTERFACE -Wshadow)
elseif(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # Names of a file are neither those of another in its batch, nor do they stand in a header.
  target_compile_options(ssphh_compile_options INTERFACE -Wshadow=local $<$<COMPILE_LANGUAGE:CXX>:-Wno-subobject-linkage>)
endif()
option(SSPHH_WARNINGS_AS_ERRORS "Treat warnings as errors" OFF)
if(SSPHH_WARNINGS_AS_ERRORS)
  target_compile_options(ssphh_compile_options INTERFACE -Werror)
endif()
if(SSPHH_SANITIZE)
  target_compile_options(ssphh_compile_options INTERFACE -fsanitize=${SSPHH_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(ssphh_compile_options INTERFACE -fsanitize=${SSPHH_SANITIZE})
  if(SSPHH_SANITIZE STREQUAL "thread")
    target_compile_definitions(ssphh_compile_options INTERFACE SSPHH_THREAD_SANITIZER)
  endif()
endif()
if(SSPHH_BUILD_FUZZERS)
  # Coverage feedback in every module, without libFuzzer's main.
  target_compile_options(ssphh_compile_options INTERFACE -fsanitize=fuzzer-no-link)
endif()
