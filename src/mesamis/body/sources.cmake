# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  make_body.h)
# For the rooms above alone: not installed.
set(ROOM_INNER_HEADERS
  body_surface.h
  size_field.h
  wall_width.h)
set(ROOM_SOURCES
  body_surface.cpp
  make_body.cpp
  size_field.cpp
  wall_width.cpp)
