# SPDX-License-Identifier: Apache-2.0
# What another project finds with find_package(mesamis): mesamis::mesamis with its header and those that it leads to, and
# the component baseline, which is found only where it is asked for.
if(NOT TARGET mesamis)
  return()
endif()
include(CMakePackageConfigHelpers)

set(MESAMIS_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/mesamis)
mesamis_rooms_of_kind(rooms library)
list(TRANSFORM rooms PREPEND mesamis_)
install(TARGETS mesamis mesamis_core ${rooms} EXPORT mesamisTargets COMPONENT development
        FILE_SET HEADERS COMPONENT development)
install(EXPORT mesamisTargets NAMESPACE mesamis:: DESTINATION ${MESAMIS_CMAKE_DIR}
        COMPONENT development)
if(MESAMIS_BUILD_BASELINE)
  install(TARGETS mesamis_baseline EXPORT mesamis_baseline COMPONENT development
          FILE_SET HEADERS COMPONENT development)
  install(EXPORT mesamis_baseline NAMESPACE mesamis:: DESTINATION ${MESAMIS_CMAKE_DIR}
          COMPONENT development)
endif()

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
