# SPDX-License-Identifier: Apache-2.0
# Which headers are public: those that a header leads to, itself included.
#   mesamis_reached(RESULT ROOT header...)   names below ROOT, sorted
function(mesamis_reached result root)
  set(reached)
  set(open ${ARGN})
  while(open)
    list(POP_BACK open header)
    if(header IN_LIST reached)
      continue()
    endif()
    list(APPEND reached ${header})
    file(STRINGS ${root}/${header} includes REGEX "^#include \"mesamis/")
    list(TRANSFORM includes REPLACE "^#include \"([^\"]+)\".*$" "\\1")
    list(APPEND open ${includes})
  endwhile()
  list(SORT reached)
  set(${result} ${reached} PARENT_SCOPE)
endfunction()
