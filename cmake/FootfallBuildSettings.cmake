# How footfall's own code is compiled. `footfall_build_settings` carries the flags; what uses the library does not
# inherit them.

if(PROJECT_IS_TOP_LEVEL)
    get_property(multi_config GLOBAL PROPERTY GENERATOR_IS_MULTI_CONFIG)
    if(NOT CMAKE_BUILD_TYPE AND NOT multi_config)
        set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release, RelWithDebInfo or MinSizeRel" FORCE)
    endif()
    set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

    find_program(CCACHE ccache)
    if(CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
        set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
    endif()

    # Everything in the build, so that the library, the tests and the tools agree.
    if(FOOTFALL_SANITIZE)
        # Looking at every pointer before every use doubles the time to compile; the address sanitizer sees what follows.
        add_compile_options(
            -fsanitize=${FOOTFALL_SANITIZE} -fno-sanitize=null,alignment,object-size -fno-sanitize-recover=all
            -fno-omit-frame-pointer -fno-optimize-sibling-calls)
        add_link_options(-fsanitize=${FOOTFALL_SANITIZE})
    endif()
endif()

set(CMAKE_CXX_EXTENSIONS OFF)

add_library(footfall_build_settings INTERFACE)
target_compile_options(footfall_build_settings INTERFACE
    $<$<CONFIG:Release>:-O3>
    # The same numbers on every machine: no fused multiply-add where the source does not ask for it.
    -ffp-contract=off
    # Nobody reads errno after sqrt; without this the compiler keeps a branch and a call for it. Changes no result.
    -fno-math-errno
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion
    # Designated initializers leave out what has a default.
    -Wno-missing-field-initializers
    # GCC 12 warns of std::string's own operator+ (GCC bug 105651).
    $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
    $<$<BOOL:${FOOTFALL_WARNINGS_AS_ERRORS}>:-Werror>)
