# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  amis.h
  functional.h)
set(ROOM_SOURCES
  amis.cpp
  functional.cpp)
