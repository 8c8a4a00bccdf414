# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  fit_surface.h)
# For the rooms above alone: not installed.
set(ROOM_INNER_HEADERS
  bending.h
  keep_volumes.h
  smooth_surface.h
  surface_moves.h)
set(ROOM_SOURCES
  bending.cpp
  fit_surface.cpp
  image_edge.cpp
  keep_volumes.cpp
  smooth_surface.cpp
  surface_moves.cpp)
