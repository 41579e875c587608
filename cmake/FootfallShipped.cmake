# The files of scenarios/ as strings in a C++ file, so that the program has them wherever it is installed.

# Sets `result` to the entries for the .toml files in `folder`; a change of one of them configures anew.
function(footfall_shipped_entries result folder)
    file(GLOB names CONFIGURE_DEPENDS RELATIVE ${folder} ${folder}/*.toml)
    list(TRANSFORM names REPLACE "\\.toml$" "")
    list(SORT names)
    set(entries "")
    foreach(name IN LISTS names)
        set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${folder}/${name}.toml)
        file(READ ${folder}/${name}.toml text)
        string(APPEND entries "    Shipped{\"${name}\", R\"toml(${text})toml\"},\n")
    endforeach()
    set(${result} "${entries}" PARENT_SCOPE)
endfunction()

# Writes what apps/footfall/shipped.hpp declares.
function(footfall_write_shipped_files output)
    footfall_shipped_entries(scenarios ${PROJECT_SOURCE_DIR}/scenarios)
    footfall_shipped_entries(rigs ${PROJECT_SOURCE_DIR}/scenarios/rigs)
    configure_file(${PROJECT_SOURCE_DIR}/cmake/shipped_files.cpp.in ${output} @ONLY)
endfunction()
