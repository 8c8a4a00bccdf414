# SPDX-License-Identifier: Apache-2.0
# Asks a test program for its tests and writes what ctest starts: the program once for the fast tests and once per label.
# MesamisTests.cmake runs it after each link.
#   cmake -DPROGRAM=test_mesh -DROOM=mesh -DLIST=mesh_list.cmake -DRESULTS=FOLDER [-DLONG=Suite.*:Suite.Test] ... -P
cmake_minimum_required(VERSION 3.25)
set(labels LONG MEASURED JUDGE)

execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
string(REPLACE ";" "," output "${output}")
string(REGEX REPLACE "\n+" ";" lines "${output}")

# "Suite.Test" of all tests, without the values that follow a '#'.
set(tests)
foreach(line IN LISTS lines)
  string(REGEX REPLACE " *#.*" "" line "${line}")
  if(line MATCHES "^([^ ]+)\\.$")
    set(suite ${CMAKE_MATCH_1})
  elseif(line MATCHES "^  ([^ ]+)$")
    list(APPEND tests ${suite}.${CMAKE_MATCH_1})
  endif()
endforeach()

# A pattern that names no test, or a test of another label, is an error.
set(fast ${tests})
foreach(label IN LISTS labels)
  string(REPLACE ":" ";" patterns "${${label}}")
  foreach(pattern IN LISTS patterns)
    string(REPLACE "." "\\." regex "${pattern}")
    string(REPLACE "*" ".*" regex "${regex}")
    set(matching ${fast})
    list(FILTER matching INCLUDE REGEX "^${regex}$")
    list(FILTER fast EXCLUDE REGEX "^${regex}$")
    if(NOT matching)
      message(FATAL_ERROR "tests/${ROOM}/CMakeLists.txt: ${label} names ${pattern}: no test, or one that has a label already")
    endif()
  endforeach()
endforeach()

set(script "")
function(add_process name filter)
  string(APPEND script "add_test([==[${name}]==] [==[${PROGRAM}]==] [==[--gtest_filter=${filter}]==]\n"
                       "  [==[--gtest_output=json:${RESULTS}/${name}.json]==])\n")
  set(script "${script}" PARENT_SCOPE)
endfunction()

foreach(label IN LISTS labels)
  if(${label})
    string(TOLOWER ${ROOM}.${label} name)
    add_process(${name} "${${label}}")
    # Long ones first: none is left alone at the end.
    string(APPEND script "set_tests_properties([==[${name}]==] PROPERTIES LABELS ${label} COST 50)\n")
  endif()
endforeach()
if(fast)
  add_process(${ROOM} "*-${LONG}:${MEASURED}:${JUDGE}")
endif()
file(WRITE ${LIST} "${script}")
