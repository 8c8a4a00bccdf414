# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  gaussian.h
  grid_axes.h
  grey_values.h
  label_map.h
  not_numbers.h
  orientation.h
  slice_source.h
  spline_image.h
  volume.h)
# For the rooms above alone: not installed.
set(ROOM_INNER_HEADERS
  slice_plane.h
  trilinear.h)
set(ROOM_SOURCES
  find_segment.cpp
  gaussian.cpp
  grid_axes.cpp
  grey_values.cpp
  label_map.cpp
  not_numbers.cpp
  orientation.cpp
  slice_plane.cpp
  slice_source.cpp
  spline_image.cpp
  volume.cpp)
