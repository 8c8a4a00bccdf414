# SPDX-License-Identifier: Apache-2.0
# What another project finds with find_package(mesamis): a set of targets for the core and for each
# room with dependencies of its own, so that none need be installed that is not used.
include(CMakePackageConfigHelpers)

set(MESAMIS_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/mesamis)
install(TARGETS mesamis EXPORT mesamisTargets COMPONENT development
        FILE_SET HEADERS COMPONENT development)
install(EXPORT mesamisTargets NAMESPACE mesamis:: DESTINATION ${MESAMIS_CMAKE_DIR}
        COMPONENT development)
get_property(mesamis_libraries GLOBAL PROPERTY MESAMIS_LIBRARIES)
foreach(room IN LISTS mesamis_libraries)
  install(TARGETS mesamis_${room} EXPORT mesamis_${room} COMPONENT development
          FILE_SET HEADERS COMPONENT development)
  install(EXPORT mesamis_${room} NAMESPACE mesamis:: DESTINATION ${MESAMIS_CMAKE_DIR}
          COMPONENT development)
endforeach()

configure_package_config_file(
  ${PROJECT_SOURCE_DIR}/cmake/mesamisConfig.cmake.in ${PROJECT_BINARY_DIR}/mesamisConfig.cmake
  INSTALL_DESTINATION ${MESAMIS_CMAKE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/mesamisConfigVersion.cmake
                                 VERSION ${PROJECT_VERSION} COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/mesamisConfig.cmake
              ${PROJECT_BINARY_DIR}/mesamisConfigVersion.cmake DESTINATION ${MESAMIS_CMAKE_DIR}
        COMPONENT development)

# Pages and examples, with their links between them.
set(pages ${CMAKE_INSTALL_DATADIR}/doc/mesamis-doc)
install(FILES README.md CONTRIBUTING.md CHANGELOG.md LICENSE DESTINATION ${pages} COMPONENT documentation)
install(DIRECTORY docs examples DESTINATION ${pages} COMPONENT documentation)
