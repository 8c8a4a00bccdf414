# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  body_surface.h
  make_body.h
  size_field.h
  wall_width.h)
set(ROOM_SOURCES
  body_surface.cpp
  make_body.cpp
  size_field.cpp
  wall_width.cpp)
