# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  edge_sides.h
  grey_values.h
  volume.h)
set(ROOM_SOURCES
  edge_sides.cpp
  grey_values.cpp
  volume.cpp)
