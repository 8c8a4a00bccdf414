# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  picture.h
  plot.h
  raster.h)
set(ROOM_SOURCES
  annotation.cpp
  axis.cpp
  color_scale.cpp
  draw_slice.cpp
  lighting.cpp
  picture.cpp
  plot.cpp
  raster.cpp
  scene.cpp
  series_style.cpp
  shaded_surface.cpp
  slice.cpp
  svg.cpp
  ticks.cpp
  triangles.cpp
  NEXT fonts.cpp
  NEXT text.cpp)
