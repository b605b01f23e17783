# ssphh_method_entries(<target> <folder>...): gives the target methods::method_entries(), which lists one method for each
# folder, in this order: what methods::<folder>::entry() says. A program that lists others than the library's own calls
# this for itself; its list then stands in place of the library's (examples/toy_method).
function(ssphh_method_entries target)
  set(declarations "")
  set(calls "")
  foreach(method IN LISTS ARGN)
    string(APPEND declarations "namespace ssphh::methods::${method} {\nMethodEntry entry();\n}\n")
    string(APPEND calls "      ${method}::entry(),\n")
  endforeach()
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${target}_entries.cpp @ONLY CONTENT
"#include <ssphh/methods/method_list.h>

@declarations@
namespace ssphh::methods {

std::vector<MethodEntry> method_entries() {
  return {
@calls@  };
}

}  // namespace ssphh::methods
")
  target_sources(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/${target}_entries.cpp)
endfunction()
