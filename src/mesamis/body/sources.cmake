# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  face_sets.h
  make_body.h
  mid_nodes.h)
# For the rooms above alone: not installed.
set(ROOM_INNER_HEADERS
  body_surface.h
  size_field.h
  wall_width.h)
set(ROOM_SOURCES
  body_surface.cpp
  face_sets.cpp
  make_body.cpp
  mid_nodes.cpp
  size_field.cpp
  wall_width.cpp)
