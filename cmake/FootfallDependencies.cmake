# What the library and the command line are built from. Tests and benchmarks find theirs in their own folders.

# Everything that is missing is said at once, with what installs it.
set(footfall_missing)
macro(footfall_find package)
    find_package(${package} ${ARGN} QUIET)
    if(NOT ${package}_FOUND)
        list(APPEND footfall_missing "${package} ${ARGV1}")
    endif()
endmacro()
macro(footfall_find_module module version)
    pkg_check_modules(footfall_${module} QUIET IMPORTED_TARGET ${module}>=${version})
    if(NOT footfall_${module}_FOUND)
        list(APPEND footfall_missing "${module} ${version}")
    endif()
endmacro()

footfall_find(Eigen3 3.4 NO_MODULE)
footfall_find(Boost 1.74 CONFIG)  # headers: Boost.Math
footfall_find(Ceres 2.1)
footfall_find(fmt 8.1)
footfall_find(nlohmann_json 3.10)
footfall_find(CLI11 2.1)

# pkg-config is what Debian, Ubuntu and conda all ship for these two; their CMake files differ from place to place.
footfall_find(PkgConfig)
if(PkgConfig_FOUND)
    footfall_find_module(tomlplusplus 3)
    footfall_find_module(netcdf 4.7)
endif()

if(footfall_missing)
    list(JOIN footfall_missing "\n  " footfall_missing)
    message(FATAL_ERROR "footfall is built from these, which were not found:\n  ${footfall_missing}\n"
        "On Debian and Ubuntu ${PROJECT_SOURCE_DIR}/scripts/install-deps.sh installs them.")
endif()
