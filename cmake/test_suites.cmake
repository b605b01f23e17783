# Read by ctest: an entry NAME.SUITE for each suite that `program` lists. What each test did lies in results/NAME.SUITE.xml
# afterwards (scripts/test_summary.py).
set(suites "${program}.suites")
if(NOT EXISTS ${program})
  add_test(${name} ${program})  # fails, and says that it is not built
  return()
endif()
if(${program} IS_NEWER_THAN ${suites})
  execute_process(COMMAND ${program} --gtest_list_tests OUTPUT_VARIABLE listed RESULT_VARIABLE code)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${program} --gtest_list_tests: ${code}\n${listed}")
  endif()
  # Suites stand at the beginning of a line and end with a point: "Builtin/Picture." or "Typed/0.  # TypeParam = float".
  string(REGEX MATCHALL "(^|\n)[A-Za-z0-9_/]+\\." lines "${listed}")
  list(TRANSFORM lines REPLACE "[\n.]" "")
  file(WRITE ${suites} "${lines}")
endif()
file(READ ${suites} lines)
foreach(suite IN LISTS lines)
  string(REPLACE "/" "-" file ${suite})
  add_test("${name}.${suite}" ${program} --gtest_filter=${suite}.* --gtest_output=xml:${results}/${name}.${file}.xml)
  set_tests_properties("${name}.${suite}" PROPERTIES TIMEOUT 600)
endforeach()
