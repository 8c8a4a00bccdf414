# SPDX-License-Identifier: Apache-2.0
# The viewer of scans that pages embed: NiiVue, as web/package-lock.json names it. npm fetches it into
# web/node_modules, once for all builds. Sets MESAMIS_VIEWER_FILE; it is empty, and pages have pictures
# alone, where there is no npm or no network.
option(MESAMIS_VIEWER "Embed the viewer of scans in pages; npm fetches it" ON)
set(MESAMIS_VIEWER_FILE "")
if(NOT MESAMIS_VIEWER OR MESAMIS_FUZZ)
  return()
endif()
set(mesamis_web ${PROJECT_SOURCE_DIR}/web)
set(mesamis_niivue ${mesamis_web}/node_modules/@niivue/niivue/dist/niivue.umd.js)
# npm ci is done when its own list of what it installed is no older than ours.
set(mesamis_npm_list ${mesamis_web}/node_modules/.package-lock.json)
if(NOT EXISTS ${mesamis_niivue} OR ${mesamis_web}/package-lock.json IS_NEWER_THAN ${mesamis_npm_list})
  find_program(NPM_PROGRAM npm)
  if(NPM_PROGRAM)
    message(STATUS "Fetching the viewer of pages: npm ci in ${mesamis_web}")
    execute_process(COMMAND ${NPM_PROGRAM} ci --ignore-scripts --no-audit --no-fund
                            --prefer-offline --fetch-retries=1 --fetch-timeout=20000
                    WORKING_DIRECTORY ${mesamis_web} TIMEOUT 300 RESULT_VARIABLE mesamis_npm_result
                    OUTPUT_QUIET ERROR_VARIABLE mesamis_npm_error)
    if(mesamis_npm_result)
      message(WARNING "npm ci in ${mesamis_web} failed: pages will have pictures, and no viewer.\n"
                      "${mesamis_npm_error}")
    endif()
  endif()
endif()
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${mesamis_web}/package-lock.json)
if(EXISTS ${mesamis_niivue})
  set(MESAMIS_VIEWER_FILE ${mesamis_niivue})
else()
  message(STATUS "No viewer (npm fetches it): pages will have pictures alone")
endif()
