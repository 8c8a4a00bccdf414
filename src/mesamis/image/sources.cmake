# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  degrade.h
  edge_sides.h
  grey_values.h
  phantom.h
  volume.h)
set(ROOM_SOURCES
  degrade.cpp
  edge_sides.cpp
  grey_values.cpp
  hemipelvis.cpp
  phantom.cpp
  phantom_designs.cpp
  volume.cpp)
