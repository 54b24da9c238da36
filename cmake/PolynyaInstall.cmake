# Installation and export, so that another CMake project can call find_package(polynya).
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

get_property(rooms GLOBAL PROPERTY POLYNYA_ROOMS)
set_target_properties(polynya_options PROPERTIES EXPORT_NAME options)
install(TARGETS ${rooms} polynya_options EXPORT polynyaTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT polynyaTargets NAMESPACE polynya:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/polynya)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/polynyaConfig.cmake.in
  ${PROJECT_BINARY_DIR}/polynyaConfig.cmake INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/polynya)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/polynyaConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/polynyaConfig.cmake ${PROJECT_BINARY_DIR}/polynyaConfigVersion.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/polynya)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/polynya COMPONENT program)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs ${PROJECT_SOURCE_DIR}/examples DESTINATION ${CMAKE_INSTALL_DOCDIR}
  COMPONENT program FILES_MATCHING PATTERN "*.md" PATTERN "*.py" PATTERN "*.geojson" PATTERN "__pycache__" EXCLUDE
  PATTERN "images" EXCLUDE)
install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR}
  COMPONENT program)
