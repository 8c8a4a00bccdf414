# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  body_fit.h
  body_skin.h
  face_sets.h
  make_body.h
  mid_nodes.h)
# For the rooms above alone: not installed.
set(ROOM_INNER_HEADERS
  body_surface.h
  junction_lines.h
  size_field.h
  wall_width.h)
set(ROOM_SOURCES
  body_fit.cpp
  body_skin.cpp
  body_surface.cpp
  face_sets.cpp
  junction_lines.cpp
  make_body.cpp
  mid_nodes.cpp
  size_field.cpp
  wall_width.cpp)
