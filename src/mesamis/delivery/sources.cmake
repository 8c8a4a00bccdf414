# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  body_output.h
  body_request.h
  cell_labels.h
  filled_objects.h
  label_output.h
  meshing_surface.h
  mesh_output.h)
set(ROOM_SOURCES
  body_output.cpp
  body_request.cpp
  cell_labels.cpp
  filled_objects.cpp
  label_output.cpp
  line_crossing.cpp
  meshing_surface.cpp
  mesh_output.cpp)
