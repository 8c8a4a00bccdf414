# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  elements.h
  outcome.h
  request.h
  segment.h
  write.h)
set(ROOM_SOURCES
  elements.cpp
  outcome.cpp
  segment.cpp
  write.cpp)
