# ssphh-<module>.pc for each module in C++, ssphh.pc for all of them and ssphh-shared.pc for libssphh.so, for builds without CMake. Static libraries carry what they
# link; the folder can be moved.
include_guard()
set(pc_dir ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
file(RELATIVE_PATH pc_up /${pc_dir} /)
string(REGEX REPLACE "/$" "" pc_up "${pc_up}")
set(ssphh_pc_head "prefix=\${pcfiledir}/${pc_up}\nlibdir=\${prefix}/${CMAKE_INSTALL_LIBDIR}\nincludedir=\${prefix}/${CMAKE_INSTALL_INCLUDEDIR}\n\nVersion: ${PROJECT_VERSION}\n")

# What a third-party target of ssphh_packages is called there; a library where it has no module.
function(ssphh_pc_name target out_modules out_libraries)
  set(row ${ssphh_packages})
  list(FILTER row INCLUDE REGEX "^${target} ")
  set(known "Threads::Threads=-pthread" "embree=-lembree3" "meshoptimizer::meshoptimizer=-lmeshoptimizer" "fmt::fmt=fmt" "spdlog::spdlog=spdlog" "glm::glm=glm"
            "TBB::tbb=tbb" "Imath::Imath=Imath" "OpenEXR::OpenEXR=OpenEXR" "nlohmann_json::nlohmann_json=nlohmann_json" "ZLIB::ZLIB=zlib" "JPEG::JPEG=libjpeg"
            "draco::draco=draco" "SQLite::SQLite3=sqlite3")
  list(FILTER known INCLUDE REGEX "^${target}=")
  if(known)
    string(REGEX REPLACE "^[^=]*=" "" name ${known})
  elseif(row MATCHES "^PkgConfig::[^ ]+ pkg-config (.*)$")
    set(name ${CMAKE_MATCH_1})
  else()
    message(FATAL_ERROR "cmake/SsphhPkgConfig.cmake lacks a name of ${target}")
  endif()
  if(name MATCHES "^-")
    set(${out_libraries} "${${out_libraries}} ${name}" PARENT_SCOPE)
  else()
    set(${out_modules} "${${out_modules}} ${name}" PARENT_SCOPE)
  endif()
endfunction()

function(ssphh_pc name description requires libraries)
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/pkgconfig/${name}.pc @ONLY CONTENT
"@ssphh_pc_head@Name: @name@
Description: @description@
Requires:@requires@
Libs: -L\${libdir}@libraries@
Cflags: -I\${includedir}
")
  install(FILES ${PROJECT_BINARY_DIR}/pkgconfig/${name}.pc DESTINATION ${pc_dir})
endfunction()

set(ssphh_pc_all "")
foreach(module IN LISTS SSPHH_MODULES)
  if(module STREQUAL "runtime")
    continue()  # ssphh-runtime.pc names the shared library
  endif()
  get_target_property(depends ssphh_${module} SSPHH_DEPENDS)
  get_target_property(links ssphh_${module} SSPHH_LINKS)
  list(REMOVE_ITEM links "")
  set(requires "")
  set(libraries " -lssphh_${module}")
  if(module STREQUAL "core")
    string(APPEND libraries " -Wl,--undefined=ssphh_cpu_check -Wl,--as-needed")
  endif()
  foreach(other IN LISTS depends)
    string(APPEND requires " ssphh-${other}")
  endforeach()
  foreach(target IN LISTS links)
    ssphh_pc_name(${target} requires libraries)
  endforeach()
  ssphh_pc(ssphh-${module} "Module ${module} of ssphh, light probes with spherical harmonics (C++20)" "${requires}" "${libraries}")
  string(APPEND ssphh_pc_all " ssphh-${module}")
endforeach()
ssphh_pc(ssphh "${PROJECT_DESCRIPTION} (C++20)" "${ssphh_pc_all}" "")
if(TARGET ssphh_shared)
  ssphh_pc(ssphh-shared "${PROJECT_DESCRIPTION} (C++20), as one shared library" " fmt glm" " -lssphh")
endif()
ssphh_pc(ssphh-runtime "Baked light of ssphh in a shipped program, without rays (C)" "" " -lssphh_runtime -lm")
