# RapidCheck, found by its header and library: not every package of it comes with a CMake file.
# Defines RapidCheck::RapidCheck.
include(FindPackageHandleStandardArgs)

find_path(RapidCheck_INCLUDE_DIR rapidcheck/gtest.h)
find_library(RapidCheck_LIBRARY rapidcheck)
mark_as_advanced(RapidCheck_INCLUDE_DIR RapidCheck_LIBRARY)
find_package_handle_standard_args(RapidCheck REQUIRED_VARS RapidCheck_LIBRARY RapidCheck_INCLUDE_DIR)

if(RapidCheck_FOUND AND NOT TARGET RapidCheck::RapidCheck)
    add_library(RapidCheck::RapidCheck UNKNOWN IMPORTED)
    set_target_properties(RapidCheck::RapidCheck PROPERTIES
        IMPORTED_LOCATION ${RapidCheck_LIBRARY}
        INTERFACE_INCLUDE_DIRECTORIES ${RapidCheck_INCLUDE_DIR})
endif()
