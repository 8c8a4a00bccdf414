# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  picture.h)
set(ROOM_SOURCES
  annotation.cpp
  color_scale.cpp
  display.cpp
  draw_slice.cpp
  picture.cpp
  scene.cpp
  slice.cpp
  vtk_data.cpp
  vtk_messages.cpp)
