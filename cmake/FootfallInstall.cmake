# `cmake --install`: library, headers, command line, scenarios, and what find_package(footfall) reads.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/footfall)

# Laws and contact sets stand in files of their own: whoever asks for these alone needs nothing else.
install(TARGETS footfall_law EXPORT footfall_law_targets)
install(TARGETS footfall_host EXPORT footfall_host_targets)
install(TARGETS footfall_core footfall_study footfall_io footfall EXPORT footfall_targets)
install(FILES include/footfall.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(TARGETS footfall_cli)
install(DIRECTORY include/footfall ${PROJECT_BINARY_DIR}/include/footfall
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
    FILES_MATCHING PATTERN "*.hpp")
install(DIRECTORY scenarios/
    DESTINATION ${CMAKE_INSTALL_DATADIR}/footfall/scenarios
    FILES_MATCHING PATTERN "*.toml")
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

install(EXPORT footfall_law_targets FILE footfallLawTargets.cmake NAMESPACE footfall:: DESTINATION ${package_dir})
install(EXPORT footfall_host_targets FILE footfallHostTargets.cmake NAMESPACE footfall:: DESTINATION ${package_dir})
install(EXPORT footfall_targets FILE footfallTargets.cmake NAMESPACE footfall:: DESTINATION ${package_dir})

get_target_property(library_type footfall_core TYPE)
string(COMPARE EQUAL ${library_type} STATIC_LIBRARY footfall_is_static)
configure_package_config_file(cmake/footfallConfig.cmake.in cmake/footfallConfig.cmake
    INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(cmake/footfallConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES
    ${PROJECT_BINARY_DIR}/cmake/footfallConfig.cmake
    ${PROJECT_BINARY_DIR}/cmake/footfallConfigVersion.cmake
    DESTINATION ${package_dir})
