# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  raster.h
  text.h
  triangles.h)
set(ROOM_SOURCES
  raster.cpp
  triangles.cpp
  NEXT fonts.cpp
  NEXT text.cpp)
