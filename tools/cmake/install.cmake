# What `cmake --install` puts in place: headers, libraries, the package find_package(rigel CONFIG) finds, the program.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS rigel_shaders rigel_lights rigel_disk_tables rigel_rigs rigel_c EXPORT rigel-targets)
install(DIRECTORY shaders/include/rigel lights/include/rigel disk_tables/include/rigel rigs/include/rigel TYPE INCLUDE)
install(FILES LICENSE README.md CHANGELOG.md TYPE DOC)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/rigel)
install(EXPORT rigel-targets NAMESPACE rigel:: DESTINATION ${package_dir})
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/rigel-config.cmake.in ${PROJECT_BINARY_DIR}/rigel-config.cmake
  INSTALL_DESTINATION ${package_dir} NO_SET_AND_CHECK_MACRO)
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/rigel-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/rigel-config.cmake ${PROJECT_BINARY_DIR}/rigel-config-version.cmake
  DESTINATION ${package_dir})

if(RIGEL_BUILD_TOOLS)
  install(TARGETS rigel)
endif()
