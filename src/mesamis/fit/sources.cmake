# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  bending.h
  close_tunnels.h
  fit_surface.h
  keep_volumes.h
  smooth_surface.h
  surface_moves.h
  terraces.h)
set(ROOM_SOURCES
  bending.cpp
  close_tunnels.cpp
  fit_surface.cpp
  image_edge.cpp
  keep_volumes.cpp
  smooth_surface.cpp
  surface_moves.cpp
  terraces.cpp)
