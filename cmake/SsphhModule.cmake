# ssphh_module(<name> [DEPENDS <module>...] [FOLDERS <folder>...] [LINK_PUBLIC <target>...] [LINK_PRIVATE <target>...]
#              [TEST_LINK <target>...])
#
# Makes the static library ssphh::<name> from src/, two folders deep, with its own include directory, and
# test_<name> from tests/*.cpp. FOLDERS beside src/ hold sources together with their tests (*_test.cpp). DEPENDS is exactly the list of modules it may include. Third-party targets go to
# LINK_PRIVATE unless their types stand in public headers.
function(ssphh_module name)
  cmake_parse_arguments(ARG "" "" "DEPENDS;FOLDERS;LINK_PUBLIC;LINK_PRIVATE;TEST_LINK" ${ARGN})
  set(target ssphh_${name})
  file(GLOB sources CONFIGURE_DEPENDS src/*.cpp src/*/*.cpp src/*/*/*.cpp)
  file(GLOB tests CONFIGURE_DEPENDS tests/*.cpp)
  foreach(folder IN LISTS ARG_FOLDERS)
    file(GLOB inside CONFIGURE_DEPENDS ${folder}/*.cpp)
    foreach(file IN LISTS inside)
      if(file MATCHES "_test\\.cpp$")
        list(APPEND tests ${file})
      else()
        list(APPEND sources ${file})
      endif()
    endforeach()
  endforeach()
  add_library(${target} STATIC ${sources})
  add_library(ssphh::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target}
    PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
    PRIVATE src)
  if(ARG_FOLDERS)
    target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  endif()
  list(TRANSFORM ARG_DEPENDS PREPEND ssphh::)
  target_link_libraries(${target}
    PUBLIC ${ARG_DEPENDS} ${ARG_LINK_PUBLIC}
    PRIVATE ${ARG_LINK_PRIVATE} $<BUILD_INTERFACE:ssphh_compile_options>)
  install(TARGETS ${target} EXPORT ssphhTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(DIRECTORY include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})

  if(SSPHH_BUILD_TESTS AND tests)
    ssphh_test(test_${name} SOURCES ${tests} LINK ssphh::${name} ${ARG_TEST_LINK})
    target_include_directories(test_${name} PRIVATE src)
    if(ARG_FOLDERS)
      target_include_directories(test_${name} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
    endif()
  endif()
  file(GLOB fuzzers CONFIGURE_DEPENDS fuzz/*.cpp)
  if(SSPHH_BUILD_FUZZERS)
    foreach(source IN LISTS fuzzers)
      get_filename_component(fuzzer ${source} NAME_WE)
      add_executable(${fuzzer} ${source})
      target_link_libraries(${fuzzer} PRIVATE ssphh::${name} ssphh_compile_options)
      target_link_options(${fuzzer} PRIVATE -fsanitize=fuzzer)
    endforeach()
  endif()
endfunction()

# ssphh_test(<name> SOURCES <file>... LINK <target>...): a GoogleTest program, one ctest entry per test.
function(ssphh_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LINK} ssphh_test_support GTest::gmock_main ssphh_compile_options)
  gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST PROPERTIES TIMEOUT 600)
endfunction()

# ssphh_benchmark(<name> SOURCES <file>... LINK <target>...): a Google Benchmark program.
function(ssphh_benchmark name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LINK} benchmark::benchmark ssphh_compile_options)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests/support)
  target_compile_definitions(${name} PRIVATE SSPHH_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
endfunction()
