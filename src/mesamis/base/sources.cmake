# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  available_memory.h
  each_once.h
  embedded_file.h
  error.h
  median.h
  message.h
  morton_code.h
  nearest_names.h
  parallel.h
  progress.h
  single_precision.h
  stopwatch.h
  sym3.h
  threads.h
  types.h
  utf8.h
  version.h
  written_number.h)
set(ROOM_SOURCES
  available_memory.cpp
  nearest_names.cpp
  sym3.cpp
  utf8.cpp
  written_number.cpp
  NEXT parallel.cpp)
