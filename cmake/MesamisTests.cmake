# SPDX-License-Identifier: Apache-2.0
# Test programs, one per room, and how ctest starts them: once for the fast tests and once per label.
#
#   mesamis_add_test(ROOM SOURCES file... [NEXT file...] [LIBRARIES target...]
#                    [LONG test...] [MEASURED test...] [JUDGE test...])
#
# A test that no list names is fast: under two seconds on a slow machine. ctest runs these as "ROOM". The lists take
# GoogleTest's names with * (Suite.*, Suite.Test, */Suite.Test/*); what they name runs as "ROOM.long" and so on, with the
# label that ctest's -L and -LE take:
#   LONG      takes more than two seconds
#   MEASURED  measures accuracy, time or memory on cases of real size
#   JUDGE     asks another program: a slicer, a solver, a browser, a job scheduler
# Files up to NEXT are compiled as one (mesamis_join).
set(MESAMIS_TEST_LABELS LONG MEASURED JUDGE)
set(MESAMIS_TEST_RESULTS ${CMAKE_BINARY_DIR}/test-results)  # a JSON file per process: scripts/test_times reads them

function(mesamis_add_test room)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES;${MESAMIS_TEST_LABELS}" ${ARGN})
  cmake_path(GET CMAKE_CURRENT_SOURCE_DIR FILENAME folder)
  mesamis_join(sources ${PROJECT_SOURCE_DIR}/tests ${folder}/ ${ARG_SOURCES})
  add_executable(test_${room} ${sources})
  target_include_directories(test_${room} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_compile_definitions(test_${room} PRIVATE MESAMIS_TEST_DATA="${MESAMIS_TEST_DATA}"
                             MESAMIS_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  target_link_libraries(test_${room} PRIVATE mesamis::phantom ${ARG_LIBRARIES}
                        nlohmann_json::nlohmann_json GTest::gmock GTest::gtest_main)
  mesamis_compile_options(test_${room})
  set(labels)
  foreach(label IN LISTS MESAMIS_TEST_LABELS)
    list(JOIN ARG_${label} ":" patterns)
    list(APPEND labels "-D${label}=${patterns}")
  endforeach()
  set(list ${CMAKE_CURRENT_BINARY_DIR}/${room}_list.cmake)
  add_custom_command(TARGET test_${room} POST_BUILD BYPRODUCTS ${list} VERBATIM
    COMMAND ${CMAKE_COMMAND} -DPROGRAM=$<TARGET_FILE:test_${room}> -DROOM=${room} -DLIST=${list}
            -DRESULTS=${MESAMIS_TEST_RESULTS} ${labels} -P ${PROJECT_SOURCE_DIR}/cmake/list_tests.cmake)
  # A program that was not built is a test that says so.
  set(tests ${CMAKE_CURRENT_BINARY_DIR}/${room}_tests.cmake)
  file(WRITE ${tests} "if(EXISTS [==[${list}]==])\n  include([==[${list}]==])\nelse()\n"
                      "  add_test(${room}_not_built test_${room}_was_not_built)\nendif()\n")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${tests})
endfunction()
