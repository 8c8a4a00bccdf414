# SPDX-License-Identifier: Apache-2.0
# What another project finds with find_package(mesamis): two sets of targets, so that the core
# can be used where VTK is not installed.
include(CMakePackageConfigHelpers)

set(MESAMIS_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/mesamis)
install(TARGETS mesamis EXPORT mesamisTargets FILE_SET HEADERS)
install(EXPORT mesamisTargets NAMESPACE mesamis:: DESTINATION ${MESAMIS_CMAKE_DIR})
if(MESAMIS_BUILD_IO)
  install(TARGETS mesamis_io EXPORT mesamisIoTargets FILE_SET HEADERS)
  install(EXPORT mesamisIoTargets NAMESPACE mesamis:: DESTINATION ${MESAMIS_CMAKE_DIR})
endif()

configure_package_config_file(
  ${PROJECT_SOURCE_DIR}/cmake/mesamisConfig.cmake.in ${PROJECT_BINARY_DIR}/mesamisConfig.cmake
  INSTALL_DESTINATION ${MESAMIS_CMAKE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/mesamisConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/mesamisConfig.cmake
              ${PROJECT_BINARY_DIR}/mesamisConfigVersion.cmake DESTINATION ${MESAMIS_CMAKE_DIR})
