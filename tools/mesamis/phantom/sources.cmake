# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  degrade.h
  implicit_surface.h
  phantom.h
  phantom_truth.h)
set(ROOM_SOURCES
  degrade.cpp
  hemipelvis.cpp
  implicit_surface.cpp
  phantom.cpp
  phantom_designs.cpp
  phantom_truth.cpp)
