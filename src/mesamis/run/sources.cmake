# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  elements.h
  outcome.h
  outcome_details.h
  run_files.h
  run_share.h
  segment.h
  segment_in_slabs.h
  write.h)
set(ROOM_SOURCES
  elements.cpp
  outcome.cpp
  outcome_details.cpp
  run_share.cpp
  segment.cpp
  segment_in_slabs.cpp
  write.cpp)
