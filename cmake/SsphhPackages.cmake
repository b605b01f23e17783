# Third-party targets of the modules, each with its package and the least version, or its module of pkg-config: one table for
# the build and for the installed package, which asks only for what the wanted components link. scripts/install-deps installs
# them all.
set(ssphh_packages
  "Threads::Threads Threads"
  "fmt::fmt fmt 9"
  "spdlog::spdlog spdlog"
  "glm::glm glm"
  "TBB::tbb TBB"
  "Imath::Imath Imath"
  "OpenEXR::OpenEXR OpenEXR 3.1"
  "nlohmann_json::nlohmann_json nlohmann_json 3.11"
  "ZLIB::ZLIB ZLIB"
  "embree embree 3.13"
  "JPEG::JPEG JPEG"
  "meshoptimizer::meshoptimizer meshoptimizer"
  "draco::draco draco 1.5"
  "SQLite::SQLite3 SQLite3"
  "PkgConfig::xxhash pkg-config libxxhash"
  "PkgConfig::spng pkg-config spng"
  "PkgConfig::webp pkg-config libwebp"
  "PkgConfig::epoxy pkg-config epoxy"
  "PkgConfig::egl pkg-config egl"
  "PkgConfig::libzmq pkg-config libzmq"
  "PkgConfig::prometheus pkg-config prometheus-cpp-core"
  "PkgConfig::yamlcpp pkg-config yaml-cpp")

# ssphh_find(<target>): looks for the target's package; afterwards the target exists, or the package is not installed.
macro(ssphh_find target)
  if(NOT TARGET ${target})
    set(ssphh_row ${ssphh_packages})
    list(FILTER ssphh_row INCLUDE REGEX "^${target} ")
    string(REPLACE " " ";" ssphh_row "${ssphh_row}")
    list(POP_FRONT ssphh_row ssphh_target ssphh_package)
    if(ssphh_package STREQUAL "pkg-config")
      string(REPLACE "PkgConfig::" "" ssphh_prefix ${target})
      find_package(PkgConfig QUIET)
      if(PkgConfig_FOUND)
        pkg_check_modules(${ssphh_prefix} QUIET IMPORTED_TARGET GLOBAL ${ssphh_row})
      endif()
    else()
      find_package(${ssphh_package} ${ssphh_row} QUIET)
    endif()
  endif()
endmacro()
