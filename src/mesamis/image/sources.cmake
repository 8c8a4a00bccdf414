# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  gaussian.h
  grey_values.h
  label_map.h
  orientation.h
  spline_image.h
  volume.h)
set(ROOM_SOURCES
  find_segment.cpp
  gaussian.cpp
  grey_values.cpp
  label_map.cpp
  orientation.cpp
  spline_image.cpp
  volume.cpp)
