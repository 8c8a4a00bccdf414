# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  comparison.h
  surface_pair.h)
set(ROOM_SOURCES
  comparison.cpp
  surface_pair.cpp)
