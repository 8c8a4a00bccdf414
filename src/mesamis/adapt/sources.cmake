# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  cell_shape.h
  estimator.h
  grid_estimator.h
  metric_from_estimate.h
  size_control.h)
set(ROOM_SOURCES
  cell_estimate.cpp
  cell_shape.cpp
  estimator.cpp
  grid_estimator.cpp
  metric_from_estimate.cpp
  size_control.cpp)
