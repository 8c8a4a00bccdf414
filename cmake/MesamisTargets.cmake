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
# Nobody reads errno after a root or catches floating-point traps; without either, loops with roots and
# choices can be vectorised, with the same results.
# gcc 12 sees overlaps where strings are added up that are not there (its bug 105651).
function(mesamis_compile_options target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror
                                           -ffp-contract=off -fno-math-errno -fno-trapping-math
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
endfunction()

# Sources read as one, where MESAMIS_JOIN_SOURCES: what takes the time is headers and templates, which are then
# compiled once. What is written has no path of this tree in it, so that the compiler cache knows it in any other.
function(mesamis_join_part result folder)
  get_property(parts DIRECTORY PROPERTY MESAMIS_JOINED)
  list(LENGTH parts number)
  list(TRANSFORM ARGN REPLACE "(.+)" "#include \"${folder}\\1\"\n" OUTPUT_VARIABLE lines)
  list(JOIN lines "" lines)
  set(file ${CMAKE_CURRENT_BINARY_DIR}/joined_${number}.cpp)
  set_property(DIRECTORY APPEND PROPERTY MESAMIS_JOINED ${file})
  file(CONFIGURE OUTPUT ${file} CONTENT "${lines}")
  set(${result} ${file} PARENT_SCOPE)
endfunction()

# Sources in parts, with NEXT between them: no name of one is that of another in its part. FOLDER/ is theirs
# below an include folder, or empty; absolute paths stay sources of their own.
function(mesamis_join result folder)
  set(part)
  set(joined)
  foreach(source IN LISTS ARGN ITEMS NEXT)
    if(source MATCHES "^/" OR NOT (MESAMIS_JOIN_SOURCES OR source STREQUAL NEXT))
      list(APPEND joined ${source})
    elseif(NOT source STREQUAL NEXT)
      list(APPEND part ${source})
    elseif(part)
      mesamis_join_part(file "${folder}" ${part})
      list(APPEND joined ${file})
      set(part)
    endif()
  endforeach()
  set(${result} ${joined} PARENT_SCOPE)
endfunction()

# Rooms whose sources have no names in common. Read as one source each, where MESAMIS_JOIN_SOURCES, the headers of the
# system are read once: half the time of a build with sanitizers, and of clang-tidy (scripts/tidy).
file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/rooms_as_one.txt MESAMIS_ROOMS_AS_ONE REGEX "^[a-z]")
if(MESAMIS_SANITIZE MATCHES thread)
  list(REMOVE_ITEM MESAMIS_ROOMS_AS_ONE base)  # parallel.cpp has options of its own then
endif()

# Adds a room to a library. Its sources.cmake names its doors (ROOM_HEADERS, which are installed), the
# headers that other rooms of the project may include as well (ROOM_INNER_HEADERS) and its sources
# (ROOM_SOURCES); any other header is the room's own.
function(mesamis_add_room target room)
  set(folder ${PROJECT_SOURCE_DIR}/src/mesamis/${room})
  include(${folder}/sources.cmake)
  list(TRANSFORM ROOM_HEADERS PREPEND ${folder}/)
  if(MESAMIS_JOIN_SOURCES AND room IN_LIST MESAMIS_ROOMS_AS_ONE)
    mesamis_join_part(ROOM_SOURCES mesamis/${room}/ ${ROOM_SOURCES})
    # A source may use another's names for its own variables.
    set_source_files_properties(${ROOM_SOURCES} PROPERTIES
      COMPILE_OPTIONS "-Wno-shadow;$<$<CXX_COMPILER_ID:GNU>:-Wshadow=local>")
  else()
    list(TRANSFORM ROOM_SOURCES PREPEND ${folder}/)
  endif()
  target_sources(${target}
    PRIVATE ${ROOM_SOURCES}
    PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR}/src FILES ${ROOM_HEADERS})
endfunction()

# A room with dependencies of its own: the library mesamis_ROOM, which is mesamis::ROOM elsewhere.
function(mesamis_add_library room)
  set(target mesamis_${room})
  add_library(${target})
  add_library(mesamis::${room} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${room})
  mesamis_add_room(${target} ${room})
  mesamis_compile_options(${target})
  mesamis_instrument(${target})
  set_property(GLOBAL APPEND PROPERTY MESAMIS_LIBRARIES ${room})
endfunction()
