# ssphh_test(<name> [TOGETHER] SOURCES <file>... LINK <target>...): a GoogleTest program, one ctest entry NAME.SUITE for each of its
# suites; TOGETHER: one entry NAME for all of them, which share what they make.
#
# gtest_discover_tests of CMake starts a process for each test: what a suite makes once for all of its tests (a bake, a context
# of OpenGL with its shaders) would be made for each of them.
set(SSPHH_TEST_OPTIONS "" CACHE STRING "Compile options of test programs, behind all others: with -Og they are compiled in half of the time that -O3 takes, and run as long")

function(ssphh_test name)
  cmake_parse_arguments(ARG "TOGETHER" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_compile_options(${name} PRIVATE ${SSPHH_TEST_OPTIONS})
  target_link_libraries(${name} PRIVATE ${ARG_LINK} ssphh_test_support GTest::gmock_main ssphh_compile_options)
  ssphh_unity(${name})
  # Read by ctest, which asks the program itself: there is none yet when CMake runs.
  set(file ${CMAKE_CURRENT_BINARY_DIR}/${name}_suites.cmake)
  file(CONFIGURE OUTPUT ${file} @ONLY CONTENT
"set(name @name@)
set(together @ARG_TOGETHER@)
set(program \"@CMAKE_RUNTIME_OUTPUT_DIRECTORY@/@name@\")
set(results \"@PROJECT_BINARY_DIR@/test-results\")
include(\"@PROJECT_SOURCE_DIR@/cmake/test_suites.cmake\")
")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${file})
endfunction()
