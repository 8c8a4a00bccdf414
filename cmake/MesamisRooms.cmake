# SPDX-License-Identifier: Apache-2.0
# The list of rooms, src/mesamis/rooms.txt: MESAMIS_ROOMS in its order, and of each room MESAMIS_KIND_room,
# MESAMIS_ROOMS_OF_room, the rooms that it leads to, and MESAMIS_ROOT_room, in whose folder mesamis/ it lies.
set(list ${PROJECT_SOURCE_DIR}/src/mesamis/rooms.txt)
set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${list})
file(STRINGS ${list} lines REGEX "^[a-z]")
foreach(line IN LISTS lines)
  separate_arguments(words UNIX_COMMAND "${line}")
  list(FILTER words EXCLUDE REGEX "^<")
  list(POP_FRONT words room MESAMIS_KIND)
  list(APPEND MESAMIS_ROOMS ${room})
  set(MESAMIS_KIND_${room} ${MESAMIS_KIND})
  set(MESAMIS_ROOMS_OF_${room} ${words})
  set(MESAMIS_ROOT_${room} ${PROJECT_SOURCE_DIR}/src)
  if(MESAMIS_KIND MATCHES "^tool")
    set(MESAMIS_ROOT_${room} ${PROJECT_SOURCE_DIR}/tools)
  endif()
endforeach()

# The rooms of some kinds, in the order of the list: those that a room includes come before it.
function(mesamis_rooms_of_kind result)
  set(rooms)
  foreach(room IN LISTS MESAMIS_ROOMS)
    if(MESAMIS_KIND_${room} IN_LIST ARGN)
      list(APPEND rooms ${room})
    endif()
  endforeach()
  set(${result} ${rooms} PARENT_SCOPE)
endfunction()
