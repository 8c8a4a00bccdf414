# SPDX-License-Identifier: Apache-2.0
# What every target of the project is compiled with.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
endif()

# Warnings are errors, and a*b+c is never fused: the same input gives the same bits everywhere.
# No code reads errno after a root or catches floating-point traps; without either, loops with roots and
# choices can be vectorised, with the same results. No function is replaced at load time: calls are inlined though the
# code is position independent.
# gcc 12 sees overlaps where strings are added up that are not there (its bug 105651).
function(mesamis_compile_options target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror
                                           -ffp-contract=off -fno-math-errno -fno-trapping-math
                                           -fno-semantic-interposition
                                           $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
                                           $<$<CXX_COMPILER_ID:Clang>:-Wno-sign-conversion>)
  if(MESAMIS_FUZZ)
    # Half of the time of a build without a compiler cache goes into these.
    target_precompile_headers(${target} PRIVATE <algorithm> <array> <cmath> <cstdint> <filesystem>
      <functional> <map> <optional> <span> <sstream> <string> <string_view> <vector>)
  endif()
  if(MESAMIS_SANITIZE)
    target_link_options(${target} PRIVATE -fsanitize=${MESAMIS_SANITIZE})
  endif()
  if(MESAMIS_COVERAGE)
    target_link_options(${target} PRIVATE --coverage)
  endif()
endfunction()

# Instruments what we ship. The tests' own code is only linked with the sanitizer: instrumenting it
# would double the build and find nothing in the library.
function(mesamis_instrument target)
  if(MESAMIS_SANITIZE)
    # Whatever is found ends the program: undefined behaviour would only be printed otherwise.
    # In instrumented code gcc takes members of the standard library for uninitialised.
    target_compile_options(${target} PRIVATE -fsanitize=${MESAMIS_SANITIZE}
                                             -fno-sanitize-recover=all -fno-omit-frame-pointer
                                             $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  endif()
  if(MESAMIS_COVERAGE)
    target_compile_options(${target} PRIVATE --coverage -fprofile-update=single -O1
                                             $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  endif()
endfunction()

# Sources compiled as one, where MESAMIS_JOIN_SOURCES: most of the time goes into headers, which are then read once.
# NEXT begins another part; no name of a source is that of another in its part. ROOT is an include folder of the target,
# FOLDER/ (or nothing) the place of the sources below it; a part of one source, or an absolute path, stays as it is.
# Unlike those of CMake's UNITY_BUILD, the files written here hold no absolute path, so that the compiler cache knows them
# in another copy of the tree (docs/decisions.md).
function(mesamis_join result root folder)
  set(part)
  set(joined)
  foreach(source IN LISTS ARGN ITEMS NEXT)
    if(source MATCHES "^/")
      list(APPEND joined ${source})
    elseif(NOT source STREQUAL NEXT)
      list(APPEND part ${folder}${source})
    endif()
    list(LENGTH part number)
    if(number GREATER 1 AND MESAMIS_JOIN_SOURCES AND source STREQUAL NEXT)
      list(TRANSFORM part REPLACE "(.+)" "#include \"\\1\"\n")
      list(JOIN part "" lines)
      get_property(before DIRECTORY PROPERTY MESAMIS_JOINED)
      list(LENGTH before number)
      set(part ${CMAKE_CURRENT_BINARY_DIR}/joined_${number}.cpp)
      set_property(DIRECTORY APPEND PROPERTY MESAMIS_JOINED ${part})
      file(CONFIGURE OUTPUT ${part} CONTENT "${lines}")
      # A source may use another's names for its own variables.
      set_source_files_properties(${part} PROPERTIES
        COMPILE_OPTIONS "-Wno-shadow;$<$<CXX_COMPILER_ID:GNU>:-Wshadow=local>")
      list(APPEND joined ${part})
      set(part)
    elseif(source STREQUAL NEXT OR NOT MESAMIS_JOIN_SOURCES)
      list(TRANSFORM part PREPEND ${root}/)
      list(APPEND joined ${part})
      set(part)
    endif()
  endforeach()
  set(${result} ${joined} PARENT_SCOPE)
endfunction()

# Adds a room to a library. Its sources.cmake names its doors (ROOM_HEADERS), the headers that other rooms may include, and
# its sources (ROOM_SOURCES, in parts as mesamis_join takes them); any other header is the room's own.
function(mesamis_add_room target room)
  set(root ${MESAMIS_ROOT_${room}})
  include(${root}/mesamis/${room}/sources.cmake)
  mesamis_join(sources ${root} mesamis/${room}/ ${ROOM_SOURCES})
  target_sources(${target} PRIVATE ${sources})
endfunction()

# A room that is a library of its own: mesamis_ROOM, which links the rooms that it leads to. LIBRARIES are others that it needs.
function(mesamis_add_library room)
  cmake_parse_arguments(ARG "" "" "LIBRARIES" ${ARGN})
  set(target mesamis_${room})
  add_library(${target})
  add_library(mesamis::${room} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${room})
  mesamis_add_room(${target} ${room})
  mesamis_compile_options(${target})
  mesamis_instrument(${target})
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${MESAMIS_ROOT_${room}}>)
  target_link_libraries(${target} PUBLIC mesamis_core PRIVATE ${ARG_LIBRARIES})
  foreach(lower IN LISTS MESAMIS_ROOMS_OF_${room})
    if(TARGET mesamis_${lower})
      target_link_libraries(${target} PUBLIC mesamis_${lower})
    endif()
  endforeach()
endfunction()
