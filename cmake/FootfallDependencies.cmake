# What the library and the command line are built from. Tests and benchmarks find theirs in their own folders.

find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(Boost 1.74 REQUIRED CONFIG)  # headers: Boost.Math
find_package(fmt 8.1 REQUIRED)
find_package(nlohmann_json 3.10 REQUIRED)
find_package(CLI11 2.1 REQUIRED)

# pkg-config is what Debian, Ubuntu and conda all ship for these two; their CMake files differ from place to place.
find_package(PkgConfig REQUIRED)
pkg_check_modules(footfall_tomlplusplus REQUIRED IMPORTED_TARGET tomlplusplus>=3)
pkg_check_modules(footfall_netcdf REQUIRED IMPORTED_TARGET netcdf>=4.7)
