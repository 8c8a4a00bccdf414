# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  gaussian.h
  grey_values.h
  spline_image.h
  volume.h)
set(ROOM_SOURCES
  gaussian.cpp
  grey_values.cpp
  spline_image.cpp
  volume.cpp)
