# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  amis.h
  functional.h
  grid_amis.h)
set(ROOM_SOURCES
  amis.cpp
  functional.cpp
  grid_amis.cpp)
