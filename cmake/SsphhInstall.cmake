# The installed CMake package: find_package(ssphh) gives the targets ssphh::<module>.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/ssphh)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/ssphhConfig.cmake.in ${PROJECT_BINARY_DIR}/ssphhConfig.cmake
  INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/ssphhConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/ssphhConfig.cmake ${PROJECT_BINARY_DIR}/ssphhConfigVersion.cmake
  DESTINATION ${package_dir})
install(EXPORT ssphhTargets NAMESPACE ssphh:: DESTINATION ${package_dir})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/schemas/ DESTINATION ${CMAKE_INSTALL_DATADIR}/ssphh/schemas)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
