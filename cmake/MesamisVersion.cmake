# SPDX-License-Identifier: Apache-2.0
# Which version this is, from git: run after project(), whose number is the fallback.
#   PROJECT_VERSION   the newest tag vX.Y.Z before this commit, or the number in project() if that is
#                     higher, as it is where the next minor version is under way
#   MESAMIS_COMMIT    "v0.2.0", "v0.2.0-5-g1234567", without a tag "1234567"; "-dirty" if files differ
#   MESAMIS_DATE      YYYY-MM-DD, of the commit; empty if unknown
# An archive made by `git archive` carries the three in cmake/archive_version.txt.
set(MESAMIS_COMMIT unknown)
set(MESAMIS_DATE "")

function(mesamis_ask_git result)
  execute_process(COMMAND ${GIT_EXECUTABLE} ${ARGN} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
                  RESULT_VARIABLE failed OUTPUT_VARIABLE answer OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(failed)
    set(answer "")
  endif()
  set(${result} "${answer}" PARENT_SCOPE)
endfunction()

# Configures again after a commit or a tag.
function(mesamis_watch_git)
  foreach(file logs/HEAD refs/tags packed-refs)
    mesamis_ask_git(path rev-parse --git-path ${file})
    get_filename_component(path "${path}" ABSOLUTE BASE_DIR ${PROJECT_SOURCE_DIR})
    if(EXISTS "${path}")
      set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${path}")
    endif()
  endforeach()
endfunction()

if(EXISTS ${PROJECT_SOURCE_DIR}/.git)
  find_package(Git QUIET)
  if(GIT_FOUND)
    mesamis_watch_git()
    mesamis_ask_git(mesamis_described describe --always --dirty --tags --match "v[0-9]*")
    mesamis_ask_git(MESAMIS_DATE log -1 --format=%cs)
  endif()
else()
  file(READ ${PROJECT_SOURCE_DIR}/cmake/archive_version.txt mesamis_archive)
  if(NOT mesamis_archive MATCHES "[$]Format:" AND mesamis_archive MATCHES "tag: *([^\n]*)\ncommit: *([^\n]*)\ndate: *([^\n]*)")
    set(mesamis_described "${CMAKE_MATCH_1}")
    set(MESAMIS_DATE "${CMAKE_MATCH_3}")
    if(NOT mesamis_described)
      set(mesamis_described "${CMAKE_MATCH_2}")  # no tag before this commit
    endif()
  endif()
endif()
if(mesamis_described)
  set(MESAMIS_COMMIT ${mesamis_described})
endif()
if(MESAMIS_COMMIT MATCHES "^v([0-9]+\\.[0-9]+\\.[0-9]+)" AND CMAKE_MATCH_1 VERSION_GREATER PROJECT_VERSION)
  set(PROJECT_VERSION ${CMAKE_MATCH_1})
endif()
