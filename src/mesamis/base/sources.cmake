# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  available_memory.h
  error.h
  frame.h
  grid_place.h
  median.h
  parallel.h
  progress.h
  stopwatch.h
  sym3.h
  types.h
  version.h)
set(ROOM_SOURCES
  available_memory.cpp
  parallel.cpp
  sym3.cpp)
