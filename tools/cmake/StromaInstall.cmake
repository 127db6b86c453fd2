# SPDX-License-Identifier: Apache-2.0
# What `cmake --install` puts where: bin/stroma, lib/libstroma-core.so, lib/stroma/ (modules with their
# manifests), include/stroma/ and lib/cmake/Stroma/, which find_package(Stroma) reads.
include(CMakePackageConfigHelpers)

set(package_folder lib/cmake/Stroma)
install(EXPORT StromaTargets NAMESPACE Stroma:: DESTINATION ${package_folder})
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/StromaConfig.cmake.in
                              ${PROJECT_BINARY_DIR}/StromaConfig.cmake
                              INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/StromaConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/StromaConfig.cmake ${PROJECT_BINARY_DIR}/StromaConfigVersion.cmake
              ${CMAKE_CURRENT_LIST_DIR}/StromaModule.cmake
        DESTINATION ${package_folder})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/scenes DESTINATION share/stroma)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/plugins/template DESTINATION share/stroma)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION share/doc/stroma)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/core DESTINATION include/stroma
        FILES_MATCHING PATTERN "*.h")
# material laws are headers alone, for other people's force fields too
install(DIRECTORY ${PROJECT_SOURCE_DIR}/components/material DESTINATION include/stroma/components
        FILES_MATCHING PATTERN "*.h")
