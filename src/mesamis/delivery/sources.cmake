# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  body_output.h
  cell_labels.h
  label_output.h
  mesh_output.h)
set(ROOM_SOURCES
  body_output.cpp
  cell_labels.cpp
  label_output.cpp
  line_crossing.cpp
  mesh_output.cpp)
