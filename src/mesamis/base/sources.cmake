# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  error.h
  median.h
  parallel.h
  progress.h
  stopwatch.h
  sym3.h
  types.h)
set(ROOM_SOURCES
  parallel.cpp
  sym3.cpp)
