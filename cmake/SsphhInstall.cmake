# The installed CMake package: find_package(ssphh COMPONENTS <module>...) gives the targets ssphh::<module>.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/ssphh)
set(module_table "set(_ssphh_modules ${SSPHH_MODULES})\n")
foreach(module IN LISTS SSPHH_MODULES)
  get_target_property(depends ssphh_${module} SSPHH_DEPENDS)
  get_target_property(links ssphh_${module} SSPHH_LINKS)
  string(APPEND module_table "set(_ssphh_${module}_depends ${depends})\nset(_ssphh_${module}_links ${links})\n")
  install(EXPORT ssphh-${module} NAMESPACE ssphh:: DESTINATION ${package_dir})
endforeach()
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/ssphhConfig.cmake.in ${PROJECT_BINARY_DIR}/ssphhConfig.cmake
  INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/ssphhConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/ssphhConfig.cmake ${PROJECT_BINARY_DIR}/ssphhConfigVersion.cmake
  ${PROJECT_SOURCE_DIR}/cmake/SsphhPackages.cmake DESTINATION ${package_dir})
install(DIRECTORY ${PROJECT_BINARY_DIR}/generated/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/schemas/ DESTINATION ${CMAKE_INSTALL_DATADIR}/ssphh/schemas)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
