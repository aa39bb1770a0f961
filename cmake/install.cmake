# SPDX-License-Identifier: BSD-3-Clause
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
get_property(rooms GLOBAL PROPERTY BEDSCOPE_ROOMS)
install(TARGETS ${rooms} EXPORT bedscope
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
        FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/bedscope)
install(TARGETS bedscope bedscope-digitise RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
set(destination ${CMAKE_INSTALL_LIBDIR}/cmake/bedscope)
install(EXPORT bedscope NAMESPACE bedscope:: FILE bedscopeTargets.cmake DESTINATION ${destination})
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/bedscopeConfig.cmake.in
                              ${PROJECT_BINARY_DIR}/bedscopeConfig.cmake
                              INSTALL_DESTINATION ${destination})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/bedscopeConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/bedscopeConfig.cmake
              ${PROJECT_BINARY_DIR}/bedscopeConfigVersion.cmake
              ${CMAKE_CURRENT_LIST_DIR}/dependencies.cmake
              ${CMAKE_CURRENT_LIST_DIR}/FindOpenCVImgcodecs.cmake
              ${CMAKE_CURRENT_LIST_DIR}/FindOpenCVImgproc.cmake DESTINATION ${destination})
# Beside the program, where curves_folder() in app/ looks for them.
install(DIRECTORY data/curves DESTINATION ${CMAKE_INSTALL_DATADIR}/bedscope)
