# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  plot.h
  ticks.h)
set(ROOM_SOURCES
  axis.cpp
  plot.cpp
  series_style.cpp
  svg.cpp
  ticks.cpp)
