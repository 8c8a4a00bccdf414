# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  picture.h)
set(ROOM_SOURCES
  annotation.cpp
  color_scale.cpp
  draw_slice.cpp
  lighting.cpp
  picture.cpp
  scene.cpp
  shaded_surface.cpp
  slice.cpp)
