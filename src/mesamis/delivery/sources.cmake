# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  cell_labels.h
  label_output.h
  mesh_output.h)
set(ROOM_SOURCES
  cell_labels.cpp
  label_output.cpp
  line_crossing.cpp
  mesh_output.cpp)
