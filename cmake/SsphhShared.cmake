# libssphh.so, ssphh::shared: an engine's modules, all but those of farms and reports, made of the objects of their static libraries. It shows
# names of ssphh alone: what it holds of other libraries' templates meets none of an engine's. A program links it or modules, not both.
set(shared_modules ${SSPHH_MODULES})
list(REMOVE_ITEM shared_modules majordomo farm report)
add_library(ssphh_shared SHARED)
add_library(ssphh::shared ALIAS ssphh_shared)
set_target_properties(ssphh_shared PROPERTIES EXPORT_NAME shared OUTPUT_NAME ssphh
  VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
  LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib
  INTERFACE_SSPHH_KIND shared COMPATIBLE_INTERFACE_STRING SSPHH_KIND
  LINK_DEPENDS ${PROJECT_SOURCE_DIR}/cmake/shared_names.map)
target_compile_features(ssphh_shared PUBLIC cxx_std_20)
target_link_libraries(ssphh_shared PUBLIC fmt::fmt glm::glm Threads::Threads PRIVATE m $<BUILD_INTERFACE:ssphh_compile_options>)
target_link_options(ssphh_shared PRIVATE -Wl,--version-script=${PROJECT_SOURCE_DIR}/cmake/shared_names.map -Wl,-Bsymbolic-functions -Wl,--as-needed
                    -Wl,--no-undefined)
target_include_directories(ssphh_shared INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
foreach(module IN LISTS shared_modules)
  get_target_property(links ssphh_${module} SSPHH_LINKS)
  target_sources(ssphh_shared PRIVATE $<TARGET_OBJECTS:ssphh_${module}>)
  target_include_directories(ssphh_shared INTERFACE $<BUILD_INTERFACE:$<TARGET_PROPERTY:ssphh_${module},INTERFACE_INCLUDE_DIRECTORIES>>)
  foreach(link IN LISTS links)
    target_link_libraries(ssphh_shared PRIVATE $<BUILD_INTERFACE:${link}>)
  endforeach()
endforeach()
install(TARGETS ssphh_shared EXPORT ssphh-shared
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT shared NAMELINK_COMPONENT library)
